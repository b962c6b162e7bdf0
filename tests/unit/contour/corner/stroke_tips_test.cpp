// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/trace_contours.h"
#include "tests/support/angles.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

using test::kDeg;

/// The legs of a stroke are one body of ink for tens of pixels before a very sharp tip, and its centre line turns back
/// there: the tip is where the legs lead to.
TEST(CornerMarks, SharpTipsOfStrokesAreFound) {
  constexpr int kSize = 500;
  for (const double opening : {14.5, 20.0, 33.0}) {
    const Vec2 tip(450.3, 250.4), half(std::cos(0.5 * opening * kDeg), std::sin(0.5 * opening * kDeg));
    const std::vector<Vec2> line{tip - 400.0 * half, tip, tip - 400.0 * Vec2(half.x(), -half.y())};
    const Scan scan =
        test::renderPage(test::strokeCoverage(line, false, 5.0, kSize, kSize), kSize, kSize, test::scannedPage(3));
    BitImage ink(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) ink.set(x, y, scan.grey.level(x, y) < 0.55 * (255.0 - 115.0 * x / kSize));
    EdgeParams edges;
    edges.mode = EdgeMode::Centreline;
    const auto set = traceContours(ink, scan.grey, edges, {}, {});
    ASSERT_TRUE(set.has_value());
    for (const double direction : {0.0, 90.0, 200.0}) {
      const std::vector<CornerMark> marks{{tip + 8.0 * Vec2(std::cos(direction * kDeg), std::sin(direction * kDeg))}};
      const auto pieces = splitAtCorners(*set, marks, {}, {});
      ASSERT_TRUE(pieces.has_value());
      ASSERT_EQ(pieces->corners.size(), 1u) << opening << ", clicked at " << direction;
      EXPECT_LE((pieces->corners[0].positionPx - tip).norm(), 0.5) << opening << ", clicked at " << direction;
    }
  }
}

// Two legs that part at this angle from the tip on, straight or bent towards or away from each other.
std::vector<Vec2> tipWithLegs(const Vec2& tip, double openingDeg, double bendPerPx) {
  std::vector<Vec2> legs;
  for (int s = -200; s <= 200; s += 4) {
    const double arc = std::abs(s), side = s < 0 ? -1.0 : 1.0, half = 0.5 * openingDeg * kDeg;
    legs.push_back(tip + Vec2(-arc * std::cos(half), side * (arc * std::sin(half) + 0.5 * bendPerPx * arc * arc)));
  }
  return legs;
}

/// Petals, noses and tails: no mark, no click. The line of one stroke goes out to where the pen turned, and no farther.
TEST(StrokeTips, TheLineReachesThePointOfAnAcuteTip) {
  constexpr int kWidth = 400, kHeight = 300;
  for (const double pen : {3.0, 5.0, 9.0}) {
    for (const double opening : {25.0, 30.0, 40.0, 55.0}) {
      for (const double bend : {-0.0012, 0.0, 0.0012}) {
        if (opening < 30.0 && bend < 0.0) continue;  // legs that touch all along
        const Vec2 tip(330.3, 150.4);
        const auto coverage = test::strokeCoverage(tipWithLegs(tip, opening, bend), false, pen, kWidth, kHeight);
        const Scan scan = test::renderPage(coverage, kWidth, kHeight, test::cleanPage());
        BitImage ink(kWidth, kHeight);
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) ink.set(x, y, scan.grey.level(x, y) < 128.0);
        EdgeParams edges;
        edges.mode = EdgeMode::Centreline;
        const auto set = traceContours(ink, scan.grey, edges, {}, {});
        ASSERT_TRUE(set.has_value());
        ASSERT_EQ(set->contours.size(), 1u) << pen << ", " << opening << ", " << bend;
        // The smoothing along a stroke rounds the line; the corner lies on its point.
        double nearest = 1e9, beyond = 0.0;
        for (const ContourPoint& p : set->contours[0].points) {
          nearest = std::min(nearest, (p.at - tip).norm());
          beyond = std::max(beyond, p.at.x() - tip.x());
        }
        EXPECT_LE(nearest, 0.5 * pen + 2.5) << pen << ", " << opening << ", " << bend;
        EXPECT_LE(beyond, 0.5) << pen << ", " << opening << ", " << bend;
        const auto pieces = splitAtCorners(*set, {{{tip}}}, {}, {});
        ASSERT_TRUE(pieces.has_value());
        ASSERT_EQ(pieces->corners.size(), 1u) << pen << ", " << opening << ", " << bend;
        EXPECT_LE((pieces->corners[0].positionPx - tip).norm(), 0.3 * pen + 1.0)
            << pen << ", " << opening << ", " << bend;
      }
    }
  }
}

}  // namespace
}  // namespace batten
