// SPDX-License-Identifier: GPL-3.0-or-later
// Lines that touch or cross at a shallow angle, so that they have common ink: against the lines that were drawn.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/dense_page.h"
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
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::vector<float> one = test::coverageOf({lines[k]}, widthsPx[k], kSharedWidthPx, kSharedHeightPx);
    for (std::size_t i = 0; i < cover.size(); ++i) cover[i] = std::max(cover[i], one[i]);
  }
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
                    const std::string& what) {
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
                     std::to_string(widthPx) + " px, radius " + std::to_string(radiusPx));
    }
  }
}

TEST(SharedInk, AThinLineThatTouchesAThickOneGoesOn) {
  const std::vector<SharedLine> lines = {arcAt({240, 180}, 4.0, 0.0, 320.0),
                                         arcAt({240, 180}, 4.0, -1.0 / 120.0, 220.0)};
  expectTheLines(lines, traced(lines, {8.0, 3.0}), 2.5, "8 and 3 px");
}

TEST(SharedInk, LinesThatCrossAtAShallowAngleGoStraightOn) {
  for (const double widthPx : {3.0, 5.0}) {
    for (const double angleDeg : {6.0, 8.0, 12.0}) {
      const std::vector<SharedLine> lines = {arcAt({240, 180}, 11.0, 0.0, 400.0),
                                             arcAt({240, 180}, 11.0 + angleDeg, 0.0, 400.0)};
      expectTheLines(lines, traced(lines, {widthPx, widthPx}), 2.0,
                     std::to_string(widthPx) + " px, " + std::to_string(angleDeg) + " degrees");
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
    expectTheLines(lines, set, 1.7, "radius " + std::to_string(radiusPx));
    EXPECT_EQ(std::ranges::count(set.contours, true, &Contour::closed), 1) << radiusPx;
  }
}

// One stroke with a branch at either end of a stretch: the stretch is no wider than the stroke, and stays one.
TEST(SharedInk, AStretchBetweenTwoBranchesIsOneLine) {
  const SharedLine stroke = arcAt({240, 180}, 0.0, 0.0, 400.0);
  SharedLine up = arcAt({180, 180}, -25.0, 0.0, 240.0), down = arcAt({300, 180}, 155.0, 0.0, 240.0);
  up.erase(up.begin(), up.begin() + 120);
  down.erase(down.begin(), down.begin() + 120);
  const ContourSet set = traced({stroke, up, down}, {4.0, 4.0, 4.0});
  ASSERT_EQ(set.contours.size(), 3u);
  double best = 1e9;
  for (const Contour& c : set.contours) best = std::min(best, farthest(stroke, positionsOf(c.points)));
  EXPECT_LT(best, 2.0);
}

}  // namespace
}  // namespace batten
