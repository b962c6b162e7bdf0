// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/span_polynomials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace batten {
namespace {

TEST(SpanPolynomials, AgreeWithTheBasisOfEveryDegreeAtEveryKindOfKnot) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int degree = 1; degree <= 7; ++degree) {
    const std::size_t order = degree + 1;
    std::vector<double> knots(order, -2.0);
    knots.insert(knots.end(), {0.0, 0.5, degree > 1 ? 0.5 : 0.7, 3.0});  // a double knot of degree 1 would be a gap
    knots.insert(knots.end(), degree, 10.0);                             // a corner
    knots.insert(knots.end(), order, 11.0);
    std::vector<Vec2> points;
    for (std::size_t i = 0; i + order < knots.size(); ++i) points.emplace_back(1e4 + uniform(random), uniform(random));
    const auto curve = NurbsCurve::make(degree, knots, points);
    ASSERT_TRUE(curve);
    const SpanPolynomials polynomials(*curve);
    for (int i = -5; i <= 1305; ++i) {
      const double u = -2.0 + i / 100.0;
      const auto expected = curve->derivatives(u, 3);
      const auto found = polynomials.at(u);
      EXPECT_LT((found[0] - expected[0]).norm(), 1e-11) << degree << " at " << u;
      EXPECT_LT((found[1] - expected[1]).norm(), 1e-9 * (1.0 + expected[1].norm())) << degree << " at " << u;
      EXPECT_LT((found[2] - expected[2]).norm(), 1e-8 * (1.0 + expected[2].norm())) << degree << " at " << u;
      const Jet jet = polynomials.derivatives(u, 3);
      for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(jet[k], found[k]);
      EXPECT_LT((jet[3] - expected[3]).norm(), 1e-7 * (1.0 + expected[3].norm())) << degree << " at " << u;
      EXPECT_EQ(jet[4], Vec2::Zero());
    }
  }
}

TEST(SpanPolynomials, ARationalCurveIsEvaluatedAsItIs) {
  const double w = std::sqrt(0.5);
  const auto quarter = NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, {{1, 0}, {1, 1}, {0, 1}}, {1, w, 1});
  ASSERT_TRUE(quarter);
  const SpanPolynomials polynomials(*quarter);
  for (int i = 0; i <= 10; ++i) {
    EXPECT_NEAR(polynomials.at(0.1 * i)[0].norm(), 1.0, 1e-15);
    EXPECT_EQ(polynomials.derivatives(0.1 * i, 3), quarter->derivatives(0.1 * i, 3));
  }
}

}  // namespace
}  // namespace batten
