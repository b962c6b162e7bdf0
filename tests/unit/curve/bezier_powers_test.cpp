// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/bezier_powers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/base/vec2.h"
#include "core/curve/bernstein.h"

namespace batten {
namespace {

TEST(BezierPowers, OfACubicAreThoseOfItsFormula) {
  // (1 - t)^3 + 6 t (1 - t)^2 + 15 t^2 (1 - t) + 11 t^3
  const std::array<double, 4> powers = powersOfBezier(std::array<double, 4>{1.0, 2.0, 5.0, 11.0});
  EXPECT_EQ(powers, (std::array<double, 4>{1.0, 3.0, 6.0, 1.0}));
}

TEST(BezierPowers, GiveThePolynomialOfEveryDegreeOverAnyWidth) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-5.0, 5.0);
  for (int degree = 0; degree <= kMostBernsteinDegree; ++degree) {
    std::vector<Vec2> points;
    for (int i = 0; i <= degree; ++i) points.emplace_back(any(random), any(random));
    for (const double width : {1.0, 0.25, 30.0}) {
      const std::vector<Vec2> powers = powersOfBezier(points, width);
      ASSERT_EQ(powers.size(), points.size());
      for (const double t : {0.0, 0.2, 0.7, 1.0}) {
        const auto weights = bernsteinPolynomials(degree, t);
        Vec2 expected = Vec2::Zero(), found = Vec2::Zero();
        for (int i = 0; i <= degree; ++i) {
          expected += weights[i] * points[i];
          found += std::pow(t * width, i) * powers[i];
        }
        EXPECT_LT((found - expected).norm(), 1e-10) << degree << " " << width << " " << t;
      }
    }
  }
}

// Evaluators rely on it: the binomial coefficients of a width of 1 are whole numbers.
TEST(BezierPowers, OfOneWeightAreTheBinomialCoefficients) {
  const auto powers = powersOfBezier(std::array<double, 6>{1.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(powers, (std::array<double, 6>{1.0, -5.0, 10.0, -10.0, 5.0, -1.0}));
}

}  // namespace
}  // namespace batten
