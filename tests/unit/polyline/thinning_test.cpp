// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/polyline/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

TEST(Thinned, KeepsEndsAndSharpPointsAndTheTolerance) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 500; ++i) points.push_back(Vec2(300.0 * std::cos(0.003 * i), 180.0 * std::sin(0.003 * i)));
  const std::vector<int> sharp = {100, 103, 333};
  const auto byStep = thinnedByStep(points, sharp, 20.0);
  const auto byTolerance = thinnedByTolerance(points, sharp, 0.5);
  for (const auto& kept : {byStep, byTolerance}) {
    EXPECT_EQ(kept.front(), 0);
    EXPECT_EQ(kept.back(), 500);
    EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
    EXPECT_LT(kept.size(), 60u);
    for (const int s : sharp) EXPECT_NE(std::find(kept.begin(), kept.end(), s), kept.end());
  }
  for (std::size_t k = 0; k + 1 < byTolerance.size(); ++k) {
    const Vec2 a = points[byTolerance[k]];
    const Vec2 chord = (points[byTolerance[k + 1]] - a).normalized();
    for (int i = byTolerance[k]; i <= byTolerance[k + 1]; ++i) {
      EXPECT_LE(std::abs(cross(chord, points[i] - a)), 0.5 + 1e-12);
    }
  }
  EXPECT_TRUE(thinnedByStep({}, {}, 1.0).empty());
  EXPECT_EQ(thinnedByStep(points, {}, 0.0).size(), points.size());
}

TEST(Thinned, TakesTheFewestOfAZigzagThatHoldTheTolerance) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0.4}, {2, 0}, {3, 2}, {4, 0}};
  EXPECT_EQ(thinnedByTolerance(points, {}, 0.5), (std::vector<int>{0, 2, 3, 4}));
  EXPECT_EQ(thinnedByTolerance(points, {}, 3.0), (std::vector<int>{0, 4}));
  EXPECT_EQ(thinnedByTolerance(points, {}, 0.0).size(), points.size());
  EXPECT_EQ(thinnedByTolerance(std::vector<Vec2>{{1, 1}}, {}, 1.0), std::vector<int>{0});
}

TEST(PointsThatStay, AreTheEndsAndTheSharpOnesBetweenThem) {
  EXPECT_EQ(pointsThatStay(10, std::vector<int>{0, 4, 7, 9}), (std::vector<int>{0, 4, 7, 9}));
  EXPECT_EQ(pointsThatStay(1, {}), std::vector<int>{0});
  EXPECT_TRUE(pointsThatStay(0, {}).empty());
}

}  // namespace
}  // namespace batten
