// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/polyline/circle_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace batten {
namespace {

std::vector<Vec2> arc(const Vec2& centre, double radius, double fromRad, double toRad, int count) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double angle = fromRad + (toRad - fromRad) * i / (count - 1);
    points.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

TEST(AlgebraicCircle, IsTheOneThatThePointsLieOn) {
  for (const double radius : {0.5, 30.0, 5000.0}) {
    const Vec2 centre(900.0, -40.0);
    const auto circle = algebraicCircle(arc(centre, radius, 0.3, 0.8, 20));
    ASSERT_TRUE(circle);
    EXPECT_LT((circle->centre - centre).norm(), 1e-8 * radius + 1e-9);
    EXPECT_NEAR(circle->radius, radius, 1e-8 * radius + 1e-9);
  }
}

TEST(AlgebraicCircle, PointsWithoutWeightDoNotCount) {
  std::vector<Vec2> points = arc({3.0, 4.0}, 10.0, 0.0, 2.0, 9);
  std::vector<double> weights(points.size(), 2.0);
  points.emplace_back(100.0, 100.0);
  weights.push_back(0.0);
  const auto circle = algebraicCircle(points, weights);
  ASSERT_TRUE(circle);
  EXPECT_NEAR(circle->radius, 10.0, 1e-9);
}

TEST(AlgebraicCircle, NoneOfALineOrOfTwoPoints) {
  EXPECT_FALSE(algebraicCircle(std::vector<Vec2>{{0.0, 0.0}, {1.0, 1.0}}));
  std::vector<Vec2> line;
  for (int i = 0; i < 30; ++i) line.emplace_back(5.0 * i, 2.0);
  EXPECT_FALSE(algebraicCircle(line));
}

}  // namespace
}  // namespace batten
