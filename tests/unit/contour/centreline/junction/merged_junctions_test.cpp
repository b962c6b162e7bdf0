// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contour/centreline/junction/find_stroke_paths.h"
#include "core/contour/centreline/skeleton/skeleton.h"
#include "core/image/bits/bit_disc.h"

namespace batten {
namespace {

// A line that bends aside by `bendPx` and back, and is split at both ends, as a brush leaves it; beside it a broader
// one.
BitImage splitLine(double bendPx) {
  constexpr int kWidth = 300, kHeight = 760;
  constexpr double kLineRadius = 8.0, kSplitRadius = 5.0, kBroadRadius = 11.0, kHalfPx = 140.0, kSplitPx = 110.0;
  constexpr double kAsidePx = 8.0, kAside = 0.3;  // how far apart the parts of a split end run, and how fast they part
  const Vec2 middle(110.0, 0.5 * kHeight);
  BitImage ink(kWidth, kHeight);
  for (double t = -1.0; t <= 1.0; t += 0.001)
    setDisc(ink, middle + Vec2(bendPx * std::cos(0.5 * std::numbers::pi * t), t * kHalfPx), kLineRadius);
  for (double s = 0.0; s <= kSplitPx; s += 0.5) {
    for (const double side : {-1.0, 1.0}) {
      const Vec2 end(0.0, kHalfPx), part(side * std::min(kAsidePx, kAside * s), s);
      setDisc(ink, middle + end + part, kSplitRadius);
      setDisc(ink, middle - end - part, kSplitRadius);
    }
  }
  for (double y = 20.0; y < kHeight - 20.0; y += 0.5) setDisc(ink, Vec2(250.0, y), kBroadRadius);
  return ink;
}

// [px] Of all stroke paths, what lies on paper.
int onPaper(const BitImage& ink) {
  BitImage skeleton = ink;
  EXPECT_TRUE(thinToSkeleton(skeleton, {}));
  int count = 0;
  for (const StrokePath& path : findStrokePaths(skeleton, ink, {}, {}))
    for (const StrokePathPoint& p : path.points)
      count += ink.at(static_cast<int>(p.at.x()), static_cast<int>(p.at.y())) ? 0 : 1;
  return count;
}

// All of it was taken for what two strokes share that cross, and led through from end to end.
TEST(MergedJunctions, ALineWithSplitEndsIsFollowedWhereItBends) {
  for (const double bendPx : {0.0, 10.0, 20.0, 30.0, 40.0}) EXPECT_EQ(onPaper(splitLine(bendPx)), 0) << bendPx;
}

}  // namespace
}  // namespace batten
