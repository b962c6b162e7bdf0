// SPDX-License-Identifier: GPL-3.0-or-later
// Ends of strokes that lie in the ink of another line, on pages of known lines: they meet that line.

#include "core/contour/centreline/ends/meeting_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/polyline/polyline_tools.h"
#include "tests/support/dense_page.h"
#include "tests/unit/contour/traced_page.h"

namespace batten {
namespace {

constexpr int kSheetWidth = 480, kSheetHeight = 360;
constexpr double kLineY = 240.0;  // of the line that the others meet

std::vector<Vec2> straight(const Vec2& from, const Vec2& to) {
  const int steps = static_cast<int>(std::ceil((to - from).norm()));
  std::vector<Vec2> line;
  for (int k = 0; k <= steps; ++k) line.push_back(from + (to - from) * (static_cast<double>(k) / steps));
  return line;
}

ContourSet tracedLines(const std::vector<std::vector<Vec2>>& lines, double widthPx) {
  return tracedPage(
      test::scanOfLines(test::coverageOf(lines, widthPx, kSheetWidth, kSheetHeight), kSheetWidth, kSheetHeight, 7)
          .grey);
}

// The end of a line that lies nearest to a place.
Vec2 nearestEnd(const ContourSet& set, const Vec2& place) {
  Vec2 nearest = Vec2::Constant(std::numeric_limits<double>::infinity());
  for (const Contour& c : set.contours) {
    for (const Vec2& at : {c.points.front().at, c.points.back().at})
      if (!c.closed && (at - place).norm() < (nearest - place).norm()) nearest = at;
  }
  return nearest;
}

// [px] From an end to the nearest line that is not its own.
double distanceToOther(const ContourSet& set, const Vec2& end) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Contour& c : set.contours) {
    if (c.points.front().at == end || c.points.back().at == end) continue;
    for (std::size_t k = 1; k < c.points.size(); ++k)
      nearest = std::min(nearest, awayFromSegment(end, c.points[k - 1].at, c.points[k].at).norm());
  }
  return nearest;
}

TEST(MeetingEnds, ABranchEndsOnTheMiddleOfTheLineItMeets) {
  for (const double widthPx : {4.0, 8.0, 12.0}) {
    for (const double angleDeg : {90.0, 60.0, 40.0}) {
      const Vec2 foot(200.0, kLineY);
      const double angle = angleDeg * std::numbers::pi / 180.0;
      const ContourSet set = tracedLines({straight({20.0, kLineY}, {460.0, kLineY}),
                                          straight(foot, foot + 180.0 * Vec2(std::cos(angle), -std::sin(angle)))},
                                         widthPx);
      ASSERT_EQ(set.contours.size(), 2u) << angleDeg;
      const Vec2 end = nearestEnd(set, foot);
      EXPECT_LT(distanceToOther(set, end), 0.05) << widthPx << " px, " << angleDeg << " degrees";
      EXPECT_NEAR(end.y(), kLineY, 0.3) << widthPx << " px, " << angleDeg << " degrees";
      EXPECT_NEAR(end.x(), foot.x(), 1.0 + 0.1 * widthPx) << widthPx << " px, " << angleDeg << " degrees";
    }
  }
}

// An arc that leaves a line gradually. Where they share their ink only one middle is seen; the other line is led on to
// it.
TEST(MeetingEnds, WhatLeavesALineByAndByTouchesIt) {
  constexpr double kRadius = 220.0, kTouchX = 120.0;
  for (const double widthPx : {4.0, 8.0}) {
    std::vector<Vec2> arc;
    for (double a = 0.0; a <= 1.2; a += 1.0 / kRadius)
      arc.emplace_back(kTouchX + kRadius * std::sin(a), kLineY - kRadius * (1.0 - std::cos(a)));
    const ContourSet set = tracedLines({straight({20.0, kLineY}, {460.0, kLineY}), arc}, widthPx);
    ASSERT_EQ(set.contours.size(), 2u) << widthPx;
    const Vec2 end = nearestEnd(set, {kTouchX, kLineY});
    EXPECT_LT(distanceToOther(set, end), 0.05) << widthPx;
    // They are a width apart 41 px (4 px wide) and 59 px (8 px) beyond where they touch.
    EXPECT_GT(end.x(), kTouchX) << widthPx;
    EXPECT_LT(end.x(), kTouchX + std::sqrt(2.0 * kRadius * widthPx)) << widthPx;
  }
}

TEST(MeetingEnds, AStrokeThatRunsIntoAShapeMeetsItsBorder) {
  constexpr double kRadius = 45.0;
  const Vec2 centre(150.0, 180.0);
  std::vector<float> coverage = test::coverageOf({straight(centre, {440.0, 150.0})}, 7.0, kSheetWidth, kSheetHeight);
  for (int y = 0; y < kSheetHeight; ++y) {
    for (int x = 0; x < kSheetWidth; ++x) {
      const double inside = kRadius - (Vec2(x + 0.5, y + 0.5) - centre).norm() + 0.5;
      float& c = coverage[std::ptrdiff_t{y} * kSheetWidth + x];
      c = std::max(c, static_cast<float>(std::clamp(inside, 0.0, 1.0)));
    }
  }
  const ContourSet set = tracedPage(test::scanOfLines(std::move(coverage), kSheetWidth, kSheetHeight, 7).grey);
  ASSERT_EQ(set.contours.size(), 2u);
  const Vec2 end = nearestEnd(set, centre);
  // The mouth is laid straight across: up to .14 px within the circle.
  EXPECT_NEAR((end - centre).norm(), kRadius, 0.8);
}

// A line of 6 px that ends at x 200, and one across at `x`.
std::vector<Contour> lineAndOneAcross(double x) {
  std::vector<Contour> lines(2);
  lines[0].points = contourPoints(straight({50.0, 100.0}, {200.0, 100.0}), true);
  lines[1].points = contourPoints(straight({x, 40.0}, {x, 160.0}), true);
  for (Contour& c : lines) {
    c.kind = ContourKind::Centreline;
    for (ContourPoint& p : c.points) p.widthPx = 6.0f;
    measureContour(c);
  }
  return lines;
}

// An end that stops 4 px before the middle of a line of 6 px. Of two letters that only blur joins each keeps its end.
TEST(MeetingEnds, WhatOnlyBlurJoinsStaysApart) {
  std::vector<Contour> lines = lineAndOneAcross(204.0);
  for (Contour& c : lines)
    for (ContourPoint& p : c.points) p.sigmaPx = 0.05f;
  lines[0].endsInInk = {false, true};
  GreyImage grey(300, 200, 60000);
  for (int y = 97; y < 103; ++y)
    for (int x = 50; x < 207; ++x) grey.row(y)[x] = 10000;
  std::vector<Contour> joined = lines, apart = lines;
  leadToLines(joined, grey, {});
  EXPECT_NEAR((joined[0].points.back().at - Vec2(204.0, 100.0)).norm(), 0.0, 0.05);
  EXPECT_TRUE(joined[1].points == lines[1].points);
  for (int y = 97; y < 103; ++y)
    for (int x = 201; x < 203; ++x) grey.row(y)[x] = 50000;
  leadToLines(apart, grey, {});
  EXPECT_TRUE(apart[0].points == lines[0].points);
}

// Where no line goes on within the ink nothing is laid on, however dark the page.
TEST(MeetingEnds, AnEndThatMeetsNoLineStays) {
  std::vector<Contour> lines = lineAndOneAcross(212.0);
  for (Contour& c : lines) c.endsInInk = {true, true};
  const std::vector<ContourPoint> before = lines[0].points;
  leadToLines(lines, GreyImage(300, 200, 10000), {});
  EXPECT_TRUE(lines[0].points == before);
}

// Where three strokes of a marker end in one place, no two of which are one stroke, their middles pass each other by:
// led on one to the other they would make a triangle.
TEST(MeetingEnds, ThreeStrokesThatEndInOnePlaceMeetThere) {
  constexpr double kWidthPx = 16.0;
  const Vec2 middle(240.0, 180.0);
  for (const double turnDeg : {0.0, 25.0, 70.0}) {
    std::vector<std::vector<Vec2>> lines;
    for (const double rayDeg : {0.0, 120.0, 240.0}) {
      const double angle = (rayDeg + turnDeg) * std::numbers::pi / 180.0;
      const Vec2 along(std::cos(angle), std::sin(angle)), begin = middle + 0.25 * kWidthPx * leftNormal(along);
      lines.push_back(straight(begin, begin + 130.0 * along));
    }
    const ContourSet set = tracedLines(lines, kWidthPx);
    ASSERT_EQ(set.contours.size(), 3u) << turnDeg;
    std::vector<Vec2> ends;
    for (const Contour& c : set.contours) {
      const Vec2 &a = c.points.front().at, &b = c.points.back().at;
      ends.push_back((a - middle).norm() < (b - middle).norm() ? a : b);
    }
    for (const Vec2& end : ends) {
      EXPECT_LT((end - ends.front()).norm(), 0.1) << turnDeg;
      EXPECT_LT((end - middle).norm(), 0.3 * kWidthPx) << turnDeg;
    }
  }
}

}  // namespace
}  // namespace batten
