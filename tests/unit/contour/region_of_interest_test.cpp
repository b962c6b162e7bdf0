// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/region_of_interest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace batten {
namespace {

Contour circle(const Vec2& centre, double radius) {
  Contour c;
  c.closed = true;
  const int n = static_cast<int>(std::lround(2.0 * std::numbers::pi * radius));
  for (int i = 0; i < n; ++i) {
    const double t = 2.0 * std::numbers::pi * i / n;
    const Vec2 at = centre + radius * Vec2(std::cos(t), std::sin(t));
    c.points.push_back(
        {.at = at, .unrefined = at + Vec2(0.1, 0.0), .refined = i % 3 != 0, .widthPx = static_cast<float>(i)});
  }
  c.lengthPx = 2.0 * std::numbers::pi * radius;
  return c;
}

TEST(RegionOfInterest, InsideAsTheWindingAngleSays) {
  // A star: the sum of the angles under which its sides are seen is an independent witness for its simple parts.
  RegionOfInterest star;
  for (int i = 0; i < 10; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 10, r = i % 2 == 0 ? 100.0 : 40.0;
    star.cornersPx.emplace_back(120.0 + r * std::cos(t), 130.0 + r * std::sin(t));
  }
  const std::vector<RegionOfInterest> regions{star, rectangleRegion({300, 50}, {250, 90})};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 320.0);
  for (int k = 0; k < 2000; ++k) {
    const Vec2 p(place(random), place(random));
    double angle = 0.0;
    for (std::size_t i = 0; i < star.cornersPx.size(); ++i) {
      const Vec2 a = star.cornersPx[i] - p, b = star.cornersPx[(i + 1) % 10] - p;
      angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
    const bool inRectangle = p.x() >= 250 && p.x() < 300 && p.y() >= 50 && p.y() < 90;
    EXPECT_EQ(isInside(regions, p), std::abs(angle) > 3.0 || inRectangle) << p.transpose();
  }
}

TEST(RegionOfInterest, WholeInkStaysAndOtherInkGoes) {
  BitImage ink(100, 40);
  for (int x = 5; x < 95; ++x) ink.set(x, 10, true);   // reaches into the region
  for (int x = 70; x < 95; ++x) ink.set(x, 30, true);  // does not
  const std::vector<RegionOfInterest> regions{rectangleRegion({0, 0}, {50, 40})};
  const BitImage kept = inkTouching(ink, regions, {});
  EXPECT_EQ(kept.count(), 90) << "no border of the region becomes a border of ink";
  EXPECT_TRUE(kept.at(94, 10));
  EXPECT_FALSE(kept.at(80, 30));
}

TEST(RegionOfInterest, LinesEndWhereTheyLeave) {
  ContourSet set;
  set.contours = {circle({200, 200}, 100), circle({200, 200}, 30), circle({900, 900}, 50)};
  set.contours[0].bridges = {{10, 20}, {600, 610}};
  const std::vector<RegionOfInterest> regions{rectangleRegion({0, 0}, {200, 1000})};
  const ContourSet kept = keepInside(set, regions, 40.0);
  ASSERT_EQ(kept.contours.size(), 2u) << "halves of two circles; the third lies outside";
  const Contour& half = kept.contours[0];
  EXPECT_FALSE(half.closed);
  EXPECT_NEAR(half.lengthPx, std::numbers::pi * 100.0, 3.0);
  EXPECT_NEAR(kept.contours[1].lengthPx, std::numbers::pi * 30.0, 3.0);
  for (std::size_t i = 0; i < half.points.size(); ++i) {
    EXPECT_LT(half.points[i].at.x(), 200.0);
    const auto original = half.points[i].widthPx.value();
    EXPECT_EQ(half.points[i], set.contours[0].points[original]) << "what belongs to a point stays with it";
    const Vec2 before = half.points[i > 0 ? i - 1 : 0].at;
    EXPECT_LT((half.points[i].at - before).norm(), 1.5) << "in order, without a jump";
  }
  EXPECT_TRUE(half.bridges.empty()) << "both bridges lie on the other half";
}

TEST(RegionOfInterest, APartOverTheSeamIsOneLineWithItsBridge) {
  ContourSet set;
  set.contours = {circle({200, 200}, 100)};  // the seam is at (300, 200)
  set.contours[0].bridges = {{3, 8}};
  const std::vector<RegionOfInterest> regions{rectangleRegion({250, 0}, {400, 400})};
  const ContourSet kept = keepInside(set, regions, 0.0);
  ASSERT_EQ(kept.contours.size(), 1u);
  EXPECT_NEAR(kept.contours[0].lengthPx, 2.0 * std::numbers::pi / 3.0 * 100.0, 3.0);
  ASSERT_EQ(kept.contours[0].bridges.size(), 1u);
  const auto [first, last] = kept.contours[0].bridges[0];
  EXPECT_EQ(kept.contours[0].points[first].at, set.contours[0].points[3].at);
  EXPECT_EQ(kept.contours[0].points[last].at, set.contours[0].points[8].at);
}

TEST(RegionOfInterest, WhatIsWhollyInsideIsUntouchedAndNonsenseIsRefused) {
  ContourSet set;
  set.contours = {circle({200, 200}, 100)};
  const std::vector<RegionOfInterest> regions{rectangleRegion({0, 0}, {400, 400})};
  const ContourSet kept = keepInside(set, regions, 40.0);
  ASSERT_EQ(kept.contours.size(), 1u);
  EXPECT_TRUE(kept.contours[0].closed);
  EXPECT_TRUE(kept.contours[0].points == set.contours[0].points);
  EXPECT_FALSE(validate(regions[0]));
  EXPECT_TRUE(validate(RegionOfInterest{{Vec2(0, 0), Vec2(1, 1)}}));
  EXPECT_TRUE(validate(rectangleRegion({5, 5}, {5, 90}))) << "no area";
  EXPECT_TRUE(validate(RegionOfInterest{{Vec2(0, 0), Vec2(std::nan(""), 1), Vec2(4, 5)}}));
}

}  // namespace
}  // namespace batten
