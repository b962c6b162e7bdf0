// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/turn_cuts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/pen_lines.h"

namespace batten {
namespace {

constexpr double kWidthPx = 4.0;

using test::alongPolygon;

Contour lineOf(const std::vector<Vec2>& points, bool closed) { return test::centreline(points, closed, kWidthPx); }

double totalLength(const std::vector<Contour>& lines) {
  double sum = 0.0;
  for (const Contour& line : lines) sum += line.lengthPx;
  return sum;
}

bool startsAndEndsAt(const std::vector<Contour>& parts, const Vec2& place) {
  bool starts = false, ends = false;
  for (const Contour& part : parts) {
    starts = starts || (part.points.front().at - place).norm() <= kWidthPx;
    ends = ends || (part.points.back().at - place).norm() <= kWidthPx;
  }
  return starts && ends;
}

TEST(TurnCuts, AnOpenLineIsCutAtItsCorners) {
  const std::vector<Vec2> corners{{10, 10}, {150, 30}, {170, 160}, {20, 170}};
  const Contour line = lineOf(alongPolygon(corners, false), false);
  const auto parts = cutAtTurns({line}, kWidthPx);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_TRUE(startsAndEndsAt(parts, corners[1]));
  EXPECT_TRUE(startsAndEndsAt(parts, corners[2]));
  EXPECT_NEAR(totalLength(parts), line.lengthPx, 1e-9);
  EXPECT_EQ(parts.front().points.front(), line.points.front());
  EXPECT_EQ(parts.back().points.back(), line.points.back());
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    EXPECT_FALSE(parts[i].closed);
    EXPECT_EQ(parts[i].points.back(), parts[i + 1].points.front()) << "they share the point of the cut";
  }
}

TEST(TurnCuts, AClosedLineOpensAtItsCorners) {
  const std::vector<Vec2> square{{20, 20}, {140, 20}, {140, 140}, {20, 140}};
  const Contour line = lineOf(alongPolygon(square, true), true);
  const auto parts = cutAtTurns({line}, kWidthPx);
  ASSERT_EQ(parts.size(), 4u);
  for (const Vec2& corner : square) EXPECT_TRUE(startsAndEndsAt(parts, corner)) << corner.transpose();
  EXPECT_NEAR(totalLength(parts), line.lengthPx, 1e-9);
  // A drop has one.
  std::vector<Vec2> drop;
  for (int i = 0; i <= 270; ++i) {
    const double a = (i - 45.0) * std::numbers::pi / 180.0;
    drop.emplace_back(100.0 + 60.0 * std::cos(a), 100.0 + 60.0 * std::sin(a));
  }
  const Vec2 tip(100.0, 100.0 - 60.0 * std::numbers::sqrt2);
  const Vec2 from = drop.back();
  for (int k = 1; k < 60; ++k) drop.push_back(from + (tip - from) * k / 60.0);
  for (int k = 0; k < 60; ++k) drop.push_back(tip + (drop.front() - tip) * k / 60.0);
  const auto open = cutAtTurns({lineOf(drop, true)}, kWidthPx);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_FALSE(open[0].closed);
  EXPECT_LT((open[0].points.front().at - tip).norm(), 2.0 * kWidthPx);
  EXPECT_EQ(open[0].points.front(), open[0].points.back());
}

TEST(TurnCuts, ArcsBendsAndShortLinesStayWhole) {
  std::vector<Contour> lines;
  for (const double radius : {4.0 * kWidthPx, 8.0 * kWidthPx, 40.0 * kWidthPx}) {
    std::vector<Vec2> circle;
    const int n = static_cast<int>(2.0 * std::numbers::pi * radius);
    for (int i = 0; i < n; ++i) {
      const double a = 2.0 * std::numbers::pi * i / n;
      circle.emplace_back(300.0 + radius * std::cos(a), 300.0 + radius * std::sin(a));
    }
    lines.push_back(lineOf(circle, true));
  }
  std::vector<Vec2> wave;
  for (int i = 0; i < 400; ++i) wave.emplace_back(i, 100.0 + 25.0 * std::sin(i / 25.0));
  lines.push_back(lineOf(wave, false));
  lines.push_back(lineOf(alongPolygon({{0, 0}, {8, 0}, {8, 8}}, false), false));
  lines.push_back(lineOf({{1, 1}}, false));
  lines.push_back(lineOf({}, true));
  const auto parts = cutAtTurns(lines, kWidthPx);
  ASSERT_EQ(parts.size(), lines.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(parts[i].points, lines[i].points) << i;
    EXPECT_EQ(parts[i].closed, lines[i].closed) << i;
  }
}

TEST(TurnCuts, BridgesAndBundlesStayWithTheirPoints) {
  Contour line = lineOf(alongPolygon({{10, 10}, {150, 10}, {150, 150}}, false), false);
  for (std::size_t i = 0; i < line.points.size(); ++i)
    line.points[i].bundle = BundleWidths{static_cast<float>(i), 1.0f};
  line.bridges = {{20, 30}, {130, 150}, {200, 210}};
  const auto parts = cutAtTurns({line}, kWidthPx);
  ASSERT_EQ(parts.size(), 2u);
  const int cut = static_cast<int>(parts[0].points.size()) - 1;
  EXPECT_NEAR(cut, 140, 4);
  EXPECT_EQ(parts[1].points.front().bundle, line.points[cut].bundle);
  using Bridges = std::vector<std::pair<int, int>>;
  EXPECT_EQ(parts[0].bridges, (Bridges{{20, 30}, {130, cut}}));
  EXPECT_EQ(parts[1].bridges, (Bridges{{0, 150 - cut}, {200 - cut, 210 - cut}}));
}

}  // namespace
}  // namespace batten
