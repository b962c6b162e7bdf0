// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/variation_energy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/curve/nurbs_curve.h"
#include "tests/unit/curve/curve_samples.h"

namespace batten {
namespace {

TEST(VariationEnergy, OfAParabolaIsTheIntegralOfItsClosedForm) {
  const double a = 0.7, w = 2.0;
  // kappa = 2a (1 + 4a^2 x^2)^(-3/2), ds = sqrt(1 + 4a^2 x^2) dx; summed by the midpoint rule.
  double energy = 0.0, length = 0.0;
  const int n = 400000;
  for (int i = 0; i < n; ++i) {
    const double x = -w + (i + 0.5) * 2.0 * w / n, q = 1.0 + 4.0 * a * a * x * x;
    const double slope = 2.0 * a * -1.5 * std::pow(q, -2.5) * 8.0 * a * a * x / std::sqrt(q);
    energy += slope * slope * std::sqrt(q) * 2.0 * w / n;
    length += std::sqrt(q) * 2.0 * w / n;
  }
  const double expected = energy * length * length * length;
  EXPECT_NEAR(variationEnergy(test::parabola(0.5 / a, w)), expected, 0.02 * expected);
}

TEST(VariationEnergy, DoesNotDependOnSizePlaceOrDirection) {
  const NurbsCurve curve = NurbsCurve::make(5, {0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3},
                                            {{0, 0}, {1, 2}, {3, 3}, {5, 2}, {6, -1}, {8, -2}, {10, 0}, {12, 1}})
                               .value();
  const double energy = variationEnergy(curve);
  EXPECT_GT(energy, 0.0);
  Eigen::Matrix2d turned;
  turned << 0.6, -0.8, 0.8, 0.6;
  EXPECT_NEAR(variationEnergy(curve.mapped(17.0 * turned, Vec2(100, -40))), energy, 1e-9 * energy);
}

TEST(VariationEnergy, VanishesForStraightLinesAndIsFiniteForPoints) {
  EXPECT_NEAR(variationEnergy(NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0}, {1, 1}, {2, 2}, {3, 3}}).value()),
              0.0, 1e-20);
  const NurbsCurve point = NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, {{4, 4}, {4, 4}, {4, 4}}).value();
  EXPECT_EQ(variationEnergy(point), 0.0);
  EXPECT_EQ(variationEnergy(NurbsCurve{}), 0.0);
}

}  // namespace
}  // namespace batten
