// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/segment_foot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace batten {
namespace {

TEST(SegmentFoot, InsideTheWayStandsUprightOnTheSegment) {
  const SegmentFoot foot = footOnSegment({3.0, 5.0}, {1.0, 1.0}, {9.0, 1.0});
  EXPECT_DOUBLE_EQ(foot.share, 0.25);
  EXPECT_EQ(foot.away, Vec2(0.0, 4.0));
}

TEST(SegmentFoot, BeyondAnEndIsThatEnd) {
  const Vec2 a(1.0, 1.0), b(3.0, 1.0);
  const SegmentFoot before = footOnSegment({-2.0, 5.0}, a, b), behind = footOnSegment({6.0, 5.0}, a, b);
  EXPECT_EQ(before.share, 0.0);
  EXPECT_EQ(before.away, Vec2(-3.0, 4.0));
  EXPECT_EQ(behind.share, 1.0);
  EXPECT_EQ(behind.away, Vec2(3.0, 4.0));
}

TEST(SegmentFoot, ASegmentWithoutLengthIsItsPoint) {
  const SegmentFoot foot = footOnSegment({4.0, 6.0}, {1.0, 2.0}, {1.0, 2.0});
  EXPECT_EQ(foot.share, 0.0);
  EXPECT_EQ(foot.away, Vec2(3.0, 4.0));
  // So is one whose length has no square.
  const SegmentFoot tiny = footOnSegment({4.0, 6.0}, {0.0, 0.0}, {1e-200, 0.0});
  EXPECT_EQ(tiny.share, 0.0);
  EXPECT_TRUE(tiny.away.allFinite());
}

TEST(SegmentFoot, NoPlaceOfTheSegmentIsNearer) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-10.0, 10.0);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec2 p(any(random), any(random)), a(any(random), any(random)), b(any(random), any(random));
    double nearest = (p - a).norm();
    for (int k = 1; k <= 1000; ++k) nearest = std::min(nearest, (p - a - k / 1000.0 * (b - a)).norm());
    const double distance = footOnSegment(p, a, b).away.norm();
    EXPECT_LE(distance, nearest + 1e-12);
    EXPECT_GE(distance, nearest - 0.0005 * (b - a).norm());
  }
}

}  // namespace
}  // namespace batten
