// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/spline_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace batten {
namespace {

std::vector<double> unevenPlaces(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(0.5, 2.0);
  std::vector<double> places{3.0};
  while (std::ssize(places) < count) places.push_back(places.back() + step(random));
  return places;
}

TEST(SplineSpace, OpenKnotsRunOnAtTheOutermostDistances) {
  const SplineSpace space = splineSpace(3, {0.0, 1.0, 3.0}, false);
  EXPECT_EQ(space.knots, (std::vector<double>{-3.0, -2.0, -1.0, 0.0, 1.0, 3.0, 5.0, 7.0, 9.0}));
  EXPECT_EQ(space.count, 5);
  EXPECT_EQ(space.unknowns, 5);
}

TEST(SplineSpace, ClosedKnotsComeRoundAgain) {
  const SplineSpace space = splineSpace(3, {0.0, 1.0, 3.0, 4.0, 6.0}, true);
  EXPECT_EQ(space.knots, (std::vector<double>{-5.0, -3.0, -2.0, 0.0, 1.0, 3.0, 4.0, 6.0, 7.0, 9.0, 10.0}));
  EXPECT_EQ(space.count, 7);
  EXPECT_EQ(space.unknowns, 4);
}

TEST(SplineSpace, TheBasisIsOneInAll) {
  for (const int degree : {2, 3, 5, 7}) {
    for (const bool closed : {false, true}) {
      const SplineSpace space = splineSpace(degree, unevenPlaces(12, 2), closed);
      for (double u = space.places.front(); u < space.places.back(); u += 0.13) {
        const BasisRow row = space.row(u, 1);
        EXPECT_NEAR(std::accumulate(row.values[0].begin(), row.values[0].begin() + degree + 1, 0.0), 1.0, 1e-13);
        EXPECT_NEAR(std::accumulate(row.values[1].begin(), row.values[1].begin() + degree + 1, 0.0), 0.0, 1e-11);
      }
    }
  }
}

TEST(SplineSpace, AnUnrolledPeriodicCurveMeetsItselfWithAllDerivatives) {
  const SplineSpace space = splineSpace(5, unevenPlaces(10, 3), true);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-10.0, 10.0);
  std::vector<Vec2> points;
  for (int i = 0; i < space.unknowns; ++i) points.emplace_back(any(random), any(random));
  const auto curve = NurbsCurve::make(5, space.knots, space.unrolled(points));
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->start(), space.places.front());
  EXPECT_EQ(curve->end(), space.places.back());
  const auto start = curve->derivatives(curve->start(), 4), end = curve->derivatives(curve->end(), 4);
  for (std::size_t order = 0; order < 5; ++order)
    EXPECT_LT((start[order] - end[order]).norm(), 1e-9 * (1.0 + start[order].norm())) << order;
}

TEST(SplineSpace, UniformPlacesAreOneApart) {
  EXPECT_EQ(uniformPlaces(3, false), (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(uniformPlaces(3, true), (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
}

}  // namespace
}  // namespace batten
