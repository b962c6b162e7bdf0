// SPDX-License-Identifier: GPL-3.0-or-later
// Lines that touch or cross at a shallow angle, so that they have common ink: against the lines that were drawn.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/contour/centreline/junction/arc_through.h"
#include "core/contour/centreline/stroke_path.h"
#include "tests/support/dense_page.h"
#include "tests/support/ink_page.h"
#include "tests/unit/contour/traced_page.h"

namespace batten {
namespace {

using SharedLine = std::vector<Vec2>;
constexpr int kSharedWidthPx = 480, kSharedHeightPx = 360;
constexpr std::uint32_t kSharedSeed = 5;

// An arc through `at` of this curvature [1/px], positive to the right of its direction, points 1 px apart.
SharedLine arcAt(const Vec2& at, double angleDeg, double curvature, double length) {
  SharedLine line;
  for (double s = -0.5 * length; s <= 0.5 * length; s += 1.0) {
    const double angle = angleDeg * std::numbers::pi / 180.0;
    const double turn = curvature * s;
    // Along and aside of the tangent at `at`.
    const double along = curvature == 0.0 ? s : std::sin(turn) / curvature;
    const double aside = curvature == 0.0 ? 0.0 : (1.0 - std::cos(turn)) / curvature;
    line.push_back(at + along * Vec2(std::cos(angle), std::sin(angle)) +
                   aside * Vec2(-std::sin(angle), std::cos(angle)));
  }
  return line;
}

ContourSet traced(const std::vector<SharedLine>& lines, const std::vector<double>& widthsPx) {
  std::vector<float> cover(std::size_t{kSharedWidthPx} * kSharedHeightPx, 0.0f);
  for (std::size_t k = 0; k < lines.size(); ++k)
    test::inkOver(cover, test::coverageOf({lines[k]}, widthsPx[k], kSharedWidthPx, kSharedHeightPx));
  return tracedPage(test::scanOfLines(std::move(cover), kSharedWidthPx, kSharedHeightPx, kSharedSeed).grey);
}

double farthest(const SharedLine& from, const SharedLine& to) {
  double most = 0.0;
  for (const Vec2& p : from) {
    double least = 1e9;
    for (const Vec2& q : to) least = std::min(least, (p - q).norm());
    most = std::max(most, least);
  }
  return most;
}

// As many lines as were drawn, each of which lies on one of those all along, and covers it.
void expectTheLines(const std::vector<SharedLine>& drawn, const ContourSet& set, double tolerancePx,
                    const testing::Message& what) {
  SCOPED_TRACE(what);
  ASSERT_EQ(set.contours.size(), drawn.size());
  for (const SharedLine& line : drawn) {
    double best = 1e9;
    for (const Contour& c : set.contours) {
      const SharedLine found = positionsOf(c.points);
      best = std::min(best, std::max(farthest(found, line), farthest(line, found)));
    }
    EXPECT_LT(best, tolerancePx);
  }
}

TEST(SharedInk, LinesThatTouchStayThemselves) {
  for (const double widthPx : {3.0, 5.0, 8.0}) {
    for (const double radiusPx : {70.0, 110.0, 200.0}) {
      const std::vector<SharedLine> lines = {arcAt({240, 180}, 10.0, 1.0 / 250.0, 300.0),
                                             arcAt({240, 180}, 10.0, -1.0 / radiusPx, 200.0)};
      expectTheLines(lines, traced(lines, {widthPx, widthPx}), 2.0,
                     testing::Message() << widthPx << " px, radius " << radiusPx);
    }
  }
}

TEST(SharedInk, AThinLineThatTouchesAThickOneGoesOn) {
  const std::vector<SharedLine> lines = {arcAt({240, 180}, 4.0, 0.0, 320.0),
                                         arcAt({240, 180}, 4.0, -1.0 / 120.0, 220.0)};
  expectTheLines(lines, traced(lines, {8.0, 3.0}), 2.5, testing::Message() << "8 and 3 px");
}

TEST(SharedInk, LinesThatCrossAtAShallowAngleGoStraightOn) {
  for (const double widthPx : {3.0, 5.0}) {
    for (const double angleDeg : {6.0, 8.0, 12.0}) {
      const std::vector<SharedLine> lines = {arcAt({240, 180}, 11.0, 0.0, 400.0),
                                             arcAt({240, 180}, 11.0 + angleDeg, 0.0, 400.0)};
      expectTheLines(lines, traced(lines, {widthPx, widthPx}), 2.0,
                     testing::Message() << widthPx << " px, " << angleDeg << " degrees");
    }
  }
}

// A wheel on the ground, and rings too small to have much ink of their own.
TEST(SharedInk, ARingOnALineIsClosed) {
  constexpr double kLineWidthPx = 3.0;
  for (const double radiusPx : {12.0, 30.0, 60.0}) {
    const Vec2 bottom(240, 240);
    const std::vector<SharedLine> lines = {arcAt(bottom, 0.0, 0.0, 300.0),
                                           arcAt(bottom, 0.0, -1.0 / radiusPx, 2.0 * std::numbers::pi * radiusPx)};
    const ContourSet set = traced(lines, {kLineWidthPx, kLineWidthPx});
    expectTheLines(lines, set, 1.7, testing::Message() << "radius " << radiusPx);
    EXPECT_EQ(std::ranges::count(set.contours, true, &Contour::closed), 1) << radiusPx;
  }
}

// A branch at either end of a stretch, each to its own side: no arcs lead through both.
TEST(SharedInk, AStrokeWithABranchAtEitherEndIsWhole) {
  const SharedLine stroke = arcAt({240, 180}, 0.0, 0.0, 400.0);
  SharedLine up = arcAt({180, 180}, -25.0, 0.0, 240.0), down = arcAt({300, 180}, 155.0, 0.0, 240.0);
  up.erase(up.begin(), up.begin() + 120);
  down.erase(down.begin(), down.begin() + 120);
  const ContourSet set = traced({stroke, up, down}, {4.0, 4.0, 4.0});
  ASSERT_EQ(set.contours.size(), 3u);
  double best = 1e9;
  for (const Contour& c : set.contours)
    best = std::min(best, std::max(farthest(stroke, positionsOf(c.points)), farthest(positionsOf(c.points), stroke)));
  EXPECT_LT(best, 2.0);
}

// The teeth of a comb, and fingers at the edge of a hand.
TEST(SharedInk, TwoBranchesOnOneSideOfALineAreNoRing) {
  const SharedLine line = arcAt({240, 240}, 0.0, 0.0, 400.0);
  for (const double widthPx : {4.0, 5.0}) {
    for (const double apartWidths : {5.5, 6.5}) {
      for (const double leanDeg : {0.0, 10.0, 20.0}) {
        SharedLine left = arcAt({240 - 0.5 * apartWidths * widthPx, 240}, -90.0 - leanDeg, 0.0, 240.0);
        SharedLine right = arcAt({240 + 0.5 * apartWidths * widthPx, 240}, -90.0 + leanDeg, 0.0, 240.0);
        for (SharedLine* branch : {&left, &right}) branch->erase(branch->begin(), branch->begin() + 120);
        const std::vector<SharedLine> lines = {line, left, right};
        expectTheLines(lines, traced(lines, {widthPx, widthPx, widthPx}), 2.0,
                       testing::Message() << widthPx << " px, " << apartWidths << " widths apart, " << leanDeg);
      }
    }
  }
}

TEST(SharedInk, ACubicThatLeavesAndArrivesOnAnArcIsCloseToIt) {
  constexpr double kRadius = 50.0;
  for (const double turn : {0.3, 1.0, 1.6}) {
    const Vec2 from(0, 0), to(kRadius * std::sin(turn), kRadius * (1.0 - std::cos(turn)));
    for (const Vec2& p : cubicBetween(from, {1, 0}, to, {std::cos(turn), std::sin(turn)}))
      EXPECT_NEAR((p - Vec2(0, kRadius)).norm(), kRadius, 0.002 * kRadius) << turn;
  }
}

TEST(SharedInk, AnArcIsFoundFromTwoStretchesOfIt) {
  SharedLine a = arcAt({0, 0}, 0.0, 1.0 / 80.0, 60.0), b = a;
  a.erase(a.begin() + 15, a.end());
  b.erase(b.begin(), b.end() - 15);
  const auto arc = arcThrough(a, b);
  ASSERT_TRUE(arc);
  EXPECT_LT(std::sqrt(squaresLeft(*arc, a)), 1e-6);
  // 1 px within the circle, whose centre lies on the side of positive y.
  EXPECT_NEAR((arc->toArc({0.0, 1.0}) - Vec2(0.0, -1.0)).norm(), 0.0, 0.02);
  EXPECT_FALSE(arcThrough({{0, 0}}, {{std::numeric_limits<double>::quiet_NaN(), 0}}));
}

}  // namespace
}  // namespace batten
