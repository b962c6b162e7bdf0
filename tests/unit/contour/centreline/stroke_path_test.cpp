// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths and widths of stroke paths, and cubics against the arcs that they stand for.
#include "core/contour/centreline/stroke_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace batten {
namespace {

StrokePath squareOf(double sidePx) {
  StrokePath path;
  for (const Vec2& at : {Vec2(0, 0), Vec2(sidePx, 0), Vec2(sidePx, sidePx), Vec2(0, sidePx)})
    path.points.push_back({at});
  return path;
}

TEST(StrokePath, AClosedOneIncludesTheWayBack) {
  StrokePath path = squareOf(7.0);
  EXPECT_DOUBLE_EQ(path.length(), 21.0);
  path.closed = true;
  EXPECT_DOUBLE_EQ(path.length(), 28.0);
  EXPECT_EQ(StrokePath{}.length(), 0.0);
}

TEST(StrokePath, WidthIsTwiceTheMedianRadiusAndAtLeastOnePixel) {
  StrokePath path = squareOf(7.0);
  EXPECT_DOUBLE_EQ(path.widthPx(), 1.0);
  path.points[0].radius = 90.0f;  // a blot
  path.points[1].radius = path.points[2].radius = path.points[3].radius = 2.5f;
  EXPECT_DOUBLE_EQ(path.widthPx(), 5.0);
  EXPECT_DOUBLE_EQ(StrokePath{}.widthPx(), 1.0);
  EXPECT_DOUBLE_EQ(medianWidth({path, squareOf(9.0)}, [](int i) { return i == 0; }), 5.0);
  EXPECT_DOUBLE_EQ(medianWidth({path}, [](int) { return false; }), 1.0);
}

TEST(StrokePath, CubicsAreCloseToTheArcsThatFit) {
  const double radiusPx = 100.0;
  for (const double deg : {10.0, 45.0, 90.0, 120.0}) {
    const double phi = deg * std::numbers::pi / 180.0;
    const Vec2 from(radiusPx, 0.0), to(radiusPx * std::cos(phi), radiusPx * std::sin(phi));
    const std::vector<Vec2> points = cubicBetween(from, {0.0, 1.0}, to, {-std::sin(phi), std::cos(phi)});
    ASSERT_EQ(std::ssize(points), std::lround((to - from).norm()) - 1);
    // The best cubic of a quarter of a circle is off by 2.7e-4 radii, and by the sixth power of the angle for others.
    const double most = 1.1 * 2.7e-4 * radiusPx * std::pow(deg / 90.0, 6.0) + 1e-9;
    for (const Vec2& p : points) EXPECT_NEAR(p.norm(), radiusPx, most) << deg;
  }
}

TEST(StrokePath, DirectionsThatLookBackGiveAStraightLine) {
  const std::vector<Vec2> points = cubicBetween({0.0, 0.0}, {-1.0, 0.0}, {10.0, 0.0}, {1.0, 0.0});
  ASSERT_EQ(points.size(), 9u);
  for (const Vec2& p : points) EXPECT_EQ(p.y(), 0.0);
  EXPECT_DOUBLE_EQ(points[4].x(), 5.0);
}

}  // namespace
}  // namespace batten
