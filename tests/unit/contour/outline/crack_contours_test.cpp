// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/crack_contours.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace batten {
namespace {

BitImage fromText(const std::vector<std::string>& rows) {
  BitImage ink(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()));
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) ink.set(x, y, rows[y][x] == '#');
  }
  return ink;
}

double signedArea(const std::vector<Vec2>& p) {
  double twice = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) twice += cross(p[i], p[(i + 1) % p.size()]);
  return 0.5 * twice;
}

ContourSet trace(const BitImage& ink, bool internal = true, double minLength = 0.0) {
  const auto set = crackContours(ink, internal, minLength, {});
  EXPECT_TRUE(set.has_value());
  return set.value_or(ContourSet{});
}

// Number of cracks between ink and paper, counted pixel by pixel.
int crackCount(const BitImage& ink) {
  int count = 0;
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) {
      if (!ink.at(x, y)) continue;
      count += !ink.at(x - 1, y) + !ink.at(x + 1, y) + !ink.at(x, y - 1) + !ink.at(x, y + 1);
    }
  }
  return count;
}

// Joining crack midpoints cuts 1/8 px^2 off every outer corner of a pixel polygon and fills as much at an inner one,
// and a closed crack path has four more of one kind than of the other. So the enclosed areas add up to the ink exactly.
void expectAreaIsInk(const BitImage& ink, const ContourSet& set) {
  double sum = 0.0;
  std::ptrdiff_t cracks = 0;
  for (const Contour& c : set.contours) {
    const double area = signedArea(unrefinedPositionsOf(c.points));
    EXPECT_EQ(c.hole, area < 0.0);
    EXPECT_NEAR(c.areaPx, std::abs(area), 1e-9 * (1.0 + std::abs(area)));
    sum += area + (c.hole ? -0.5 : 0.5);
    cracks += std::ssize(c.points);
    double length = 0.0;
    for (std::size_t i = 0; i < c.points.size(); ++i)
      length += (c.points[(i + 1) % c.points.size()].unrefined - c.points[i].unrefined).norm();
    EXPECT_NEAR(c.lengthPx, length, 1e-9 * length);
  }
  EXPECT_NEAR(sum, static_cast<double>(ink.count()), 1e-6);
  EXPECT_EQ(cracks, crackCount(ink));
}

TEST(CrackContours, SinglePixelIsADiamondClockwiseOnTheScreen) {
  const BitImage ink = fromText({"...", ".#.", "..."});
  const ContourSet set = trace(ink);
  ASSERT_EQ(set.contours.size(), 1u);
  const std::vector<Vec2> expected{{1, 1.5}, {1.5, 1}, {2, 1.5}, {1.5, 2}};
  EXPECT_EQ(unrefinedPositionsOf(set.contours[0].points), expected);
  EXPECT_GT(signedArea(expected), 0.0);  // y down: positive is clockwise on the screen, ink on the right of travel
  expectAreaIsInk(ink, set);
}

TEST(CrackContours, RingHasAnOuterBorderAndAHole) {
  const BitImage ink = fromText({"######", "#....#", "#.##.#", "#....#", "######"});
  const ContourSet all = trace(ink);
  ASSERT_EQ(all.contours.size(), 3u);  // ring outside, its hole, the island in it
  EXPECT_EQ(std::count_if(all.contours.begin(), all.contours.end(), [](const Contour& c) { return c.hole; }), 1);
  expectAreaIsInk(ink, all);
  const ContourSet outer = trace(ink, false);
  EXPECT_EQ(outer.contours.size(), 2u);
  EXPECT_EQ(outer.report.droppedHoles, 1);
  EXPECT_EQ(outer.report.found, 3);
}

TEST(CrackContours, DiagonalTouchIsOnePiece) {
  const BitImage ink = fromText({"#.", ".#"});
  const ContourSet set = trace(ink);
  ASSERT_EQ(set.contours.size(), 1u);
  EXPECT_EQ(set.contours[0].points.size(), 8u);
  expectAreaIsInk(ink, set);
  EXPECT_EQ(trace(fromText({".#", "#."})).contours.size(), 1u);
}

TEST(CrackContours, DiagonalRingEnclosesAHole) {
  const BitImage ink = fromText({".#.", "#.#", ".#."});
  const ContourSet set = trace(ink);
  ASSERT_EQ(set.contours.size(), 2u);
  expectAreaIsInk(ink, set);
}

TEST(CrackContours, InkAtThePageBorderIsClosedAlongIt) {
  const BitImage ink = fromText({"##", "##"});
  const ContourSet set = trace(ink);
  ASSERT_EQ(set.contours.size(), 1u);
  EXPECT_EQ(set.contours[0].points.size(), 8u);
  expectAreaIsInk(ink, set);
}

TEST(CrackContours, Checkerboard) {
  BitImage ink(67, 33);
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) ink.set(x, y, (x + y) % 2 == 0);
  }
  const ContourSet set = trace(ink);
  const auto holes = std::count_if(set.contours.begin(), set.contours.end(), [](const Contour& c) { return c.hole; });
  EXPECT_EQ(std::ssize(set.contours) - holes, 1);  // all ink is joined over corners
  EXPECT_EQ(holes, 65 * 31 / 2);                   // every paper pixel inside is a hole of its own
  expectAreaIsInk(ink, set);
}

TEST(CrackContours, RandomInkIsAccountedForToThePixel) {
  std::mt19937 random(7);
  for (const int percent : {5, 30, 50, 70, 95}) {
    BitImage ink(131, 77);
    for (int y = 0; y < ink.height; ++y) {
      for (int x = 0; x < ink.width; ++x) ink.set(x, y, static_cast<int>(random() % 100) < percent);
    }
    expectAreaIsInk(ink, trace(ink));
  }
}

TEST(CrackContours, ConsecutivePointsAreNeighboursAndInkLiesOnTheRight) {
  std::mt19937 random(3);
  BitImage ink(60, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) ink.set(x, y, random() % 2 == 0);
  }
  for (const Contour& c : trace(ink).contours) {
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      const Vec2 step = c.points[(i + 1) % c.points.size()].unrefined - c.points[i].unrefined;
      EXPECT_LE(step.norm(), 1.0 + 1e-12);
      // On a straight step the pixel on the right of travel (y down: x' = -y, y' = x) is ink, the left one paper.
      if (step.norm() < 0.99) continue;
      const Vec2 right = c.points[i].unrefined + 0.5 * leftNormal(step) + 0.0 * step,
                 left = c.points[i].unrefined - 0.5 * leftNormal(step);
      EXPECT_TRUE(ink.at(static_cast<int>(std::floor(right.x())), static_cast<int>(std::floor(right.y()))));
      EXPECT_FALSE(ink.at(static_cast<int>(std::floor(left.x())), static_cast<int>(std::floor(left.y()))));
    }
  }
}

TEST(CrackContours, ShortOnesAreDroppedAndCounted) {
  const BitImage ink = fromText({"#.........", "...#######", "...#######"});
  const ContourSet set = trace(ink, true, 10.0);
  EXPECT_EQ(set.contours.size(), 1u);
  EXPECT_EQ(set.report.found, 2);
  EXPECT_EQ(set.report.droppedShort, 1);
}

TEST(CrackContours, EmptyAndCancelled) {
  EXPECT_TRUE(trace(BitImage(10, 10)).contours.empty());
  EXPECT_TRUE(trace(BitImage(0, 0)).contours.empty());
  RunContext context;
  context.cancel.cancel();
  const auto set = crackContours(fromText({"#"}), true, 0.0, context);
  ASSERT_FALSE(set.has_value());
  EXPECT_EQ(set.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace batten
