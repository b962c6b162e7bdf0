// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/polyline/polyline_tools.h"

#include <gtest/gtest.h>

#include <vector>

namespace batten {
namespace {

constexpr double kScales[] = {1e-3, 1.0, 1e4};

std::vector<Vec2> parabola(const std::vector<double>& s, const Vec2& r0, const Vec2& r1, const Vec2& r2) {
  std::vector<Vec2> points;
  for (const double at : s) points.emplace_back(r0 + r1 * at + r2 * (0.5 * at * at));
  return points;
}

TEST(LocalQuadratic, IsTheParabolaThatThePointsLieOn) {
  const Vec2 r0(900.0, -40.0), r1(0.8, 0.6), r2(-0.006, 0.008);
  for (const double scale : kScales) {
    std::vector<double> s;
    for (int i = -3; i <= 5; ++i) s.push_back(i * scale);
    const LocalQuadratic fit = fitLocalQuadratic(s, parabola(s, r0, r1 / scale, r2 / (scale * scale)), {});
    EXPECT_EQ(fit.order, 2) << scale;
    EXPECT_LT((fit.r0 - r0).norm(), 1e-10) << scale;
    EXPECT_LT((fit.r1 * scale - r1).norm(), 1e-10) << scale;
    EXPECT_LT((fit.r2 * scale * scale - r2).norm(), 1e-10) << scale;
    EXPECT_LT(fit.residualRms, 1e-10) << scale;
  }
}

// Two places tell a line, one a mean, however many points stand there and however large the positions are.
TEST(LocalQuadratic, IsOfNoHigherOrderThanThePositionsDetermine) {
  for (const double scale : kScales) {
    const std::vector<double> two{0.0, 0.0, scale, scale};
    const LocalQuadratic line = fitLocalQuadratic(two, std::vector<Vec2>{{1, 1}, {1, 3}, {5, 2}, {5, 4}}, {});
    EXPECT_EQ(line.order, 1) << scale;
    EXPECT_LT((line.at(0.0) - Vec2(1.0, 2.0)).norm(), 1e-10) << scale;
    EXPECT_LT((line.at(scale) - Vec2(5.0, 3.0)).norm(), 1e-10) << scale;
    EXPECT_NEAR(line.residualRms, 1.0, 1e-10) << scale;

    const std::vector<double> one{scale, scale, scale};
    const LocalQuadratic mean = fitLocalQuadratic(one, std::vector<Vec2>{{1, 1}, {1, 3}, {4, 2}}, {});
    EXPECT_EQ(mean.order, 0) << scale;
    EXPECT_LT((mean.r0 - Vec2(2.0, 2.0)).norm(), 1e-10) << scale;
  }
  EXPECT_FALSE(fitLocalQuadratic({}, {}, {}).order);
}

// A point of weight 3 counts as three points.
TEST(LocalQuadratic, CountsPointsByTheirWeights) {
  const std::vector<double> s{-2.0, -1.0, 0.0, 1.5, 3.0};
  const std::vector<Vec2> points{{0, 1}, {1, 0}, {2, 2}, {4, 1}, {5, 5}};
  const std::vector<double> weights{1.0, 1.0, 3.0, 1.0, 1.0};
  std::vector<double> repeatedS = s;
  std::vector<Vec2> repeated = points;
  for (int i = 0; i < 2; ++i) repeatedS.push_back(s[2]), repeated.push_back(points[2]);
  const LocalQuadratic weighed = fitLocalQuadratic(s, points, weights),
                       plain = fitLocalQuadratic(repeatedS, repeated, {});
  for (const double at : s) EXPECT_LT((weighed.at(at) - plain.at(at)).norm(), 1e-12) << at;
  EXPECT_NEAR(weighed.residualRms, plain.residualRms, 1e-12);
}

}  // namespace
}  // namespace batten
