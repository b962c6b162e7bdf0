// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/rounded_corner.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace batten {
namespace {

Joint jointAt(const Vec2& p, double angle, double kappa) { return {p, {std::cos(angle), std::sin(angle)}, kappa}; }

void expectJoins(const RoundedCorner& corner, const Joint& before, const Joint& behind) {
  const Joint start = corner.arcs[0].startJoint(), end = corner.arcs[1].endJoint();
  const double size = (behind.point - before.point).norm();
  EXPECT_LT((start.point - before.point).norm(), 1e-12 * size);
  EXPECT_LT((end.point - behind.point).norm(), 1e-9 * size);
  EXPECT_NEAR(cross(start.tangent, before.tangent), 0.0, 1e-12);
  EXPECT_NEAR(cross(end.tangent, behind.tangent), 0.0, 1e-9);
  EXPECT_GT(end.tangent.dot(behind.tangent), 0.0);
  const Joint first = corner.arcs[0].endJoint(), second = corner.arcs[1].startJoint();
  EXPECT_LT((first.point - second.point).norm(), 1e-12 * size);
  EXPECT_NEAR(cross(first.tangent, second.tangent), 0.0, 1e-12);
  EXPECT_NEAR(first.kappa, second.kappa, 1e-9 * std::abs(first.kappa));
  EXPECT_GT(std::abs(first.kappa), std::abs(start.kappa));
  EXPECT_TRUE(corner.arcs[0].isMonotone());
  EXPECT_TRUE(corner.arcs[1].isMonotone());
}

TEST(RoundCorner, IsSymmetricBetweenStraightLines) {
  for (const double side : {1.0, -1.0}) {
    const Joint before = jointAt({-10, 0}, 0.0, 0.0),
                behind = jointAt({0, side * 10}, side * std::numbers::pi / 2, 0.0);
    const auto corner = roundCorner(before, behind, 0.8);
    ASSERT_TRUE(corner);
    EXPECT_FALSE(corner->curvatureAtEnds);
    expectJoins(*corner, before, behind);
    // The middle lies on the diagonal through the corner at the origin.
    const Vec2 middle = corner->arcs[1].start;
    EXPECT_NEAR(middle.x(), -side * middle.y(), 1e-9);
    // Between the corner and a circular arc that touches at the same places.
    EXPECT_LT(middle.norm(), 10.0 * (std::sqrt(2.0) - 1.0) * 1.001);
    EXPECT_GT(middle.norm(), 1.0);
  }
}

TEST(RoundCorner, TakesAnyTurnAndUnevenLegs) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int made = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double turn = (trial % 2 == 0 ? 1.0 : -1.0) * (0.1 + 2.2 * unit(random)), angle = 6.0 * unit(random);
    const double a = 5.0, b = a * (0.8 + 0.45 * unit(random));
    const Joint before = jointAt({3, 4}, angle, 0.0);
    const Vec2 vertex = before.point + a * before.tangent;
    Joint behind = jointAt(vertex, angle + turn, 0.0);
    behind.point += b * behind.tangent;
    const auto corner = roundCorner(before, behind, 0.3 + 0.7 * unit(random));
    if (!corner) continue;
    ++made;
    expectJoins(*corner, before, behind);
  }
  EXPECT_GT(made, 270);
}

TEST(RoundCorner, MeetsTheCurvatureOfBentNeighbours) {
  const Joint before = jointAt({-10, 0}, 0.0, 0.03), behind = jointAt({0, 10}, std::numbers::pi / 2, 0.03);
  const auto corner = roundCorner(before, behind, 0.8);
  ASSERT_TRUE(corner);
  expectJoins(*corner, before, behind);
  ASSERT_TRUE(corner->curvatureAtEnds);
  EXPECT_NEAR(corner->arcs[0].startCurvature(), 0.03, 1e-9);
  EXPECT_NEAR(corner->arcs[1].endCurvature(), 0.03, 1e-9);
}

TEST(RoundCorner, IsAbsentWhereThereIsNoCorner) {
  EXPECT_FALSE(roundCorner(jointAt({0, 0}, 0, 0), jointAt({10, 0}, 0, 0), 0.8));
  EXPECT_FALSE(roundCorner(jointAt({0, 0}, 0, 0), jointAt({-10, 5}, 1.0, 0), 0.8));
  EXPECT_FALSE(roundCorner(jointAt({0, 0}, 0, 0), jointAt({0, 0}, 1.0, 0), 0.8));
}

}  // namespace
}  // namespace batten
