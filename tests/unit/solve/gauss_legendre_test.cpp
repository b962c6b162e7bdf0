// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace batten;

template <std::size_t N>
void expectExact(double from, double to) {
  constexpr int kDegree = 2 * static_cast<int>(N) - 1;
  const QuadratureRule<N> rule = gaussLegendre<N>(from, to);
  for (int degree = 0; degree <= kDegree; ++degree) {
    double sum = 0.0;
    for (std::size_t i = 0; i < N; ++i) sum += rule.weight[i] * std::pow(rule.node[i], degree);
    const double exact = (std::pow(to, degree + 1) - std::pow(from, degree + 1)) / (degree + 1);
    EXPECT_NEAR(sum, exact, 4e-15 * std::pow(std::max(std::abs(from), std::abs(to)), degree + 1))
        << N << " points, degree " << degree;
  }
  for (std::size_t i = 0; i < N; ++i) {
    EXPECT_GT(rule.node[i], i == 0 ? from : rule.node[i - 1]);
    EXPECT_LT(rule.node[i], to);
    EXPECT_GT(rule.weight[i], 0.0);
  }
}

TEST(GaussLegendre, IsExactForPolynomialsOfDegreeTwoNMinusOne) {
  expectExact<1>(-1.0, 1.0);
  expectExact<2>(-1.0, 1.0);
  expectExact<3>(0.0, 1.0);
  expectExact<4>(0.0, 1.0);
  expectExact<5>(-1.0, 1.0);
  expectExact<7>(0.0, 1.0);
  expectExact<10>(-1.0, 1.0);
  expectExact<10>(-2.0, 3.0);
}

TEST(GaussLegendre, HasTheClosedFormsOfTwoAndThreePoints) {
  constexpr auto two = gaussLegendre<2>();
  EXPECT_DOUBLE_EQ(two.node[1], 1.0 / std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(two.weight[0], 1.0);
  constexpr auto three = gaussLegendre<3>();
  EXPECT_DOUBLE_EQ(three.node[0], -std::sqrt(0.6));
  EXPECT_NEAR(three.node[1], 0.0, 1e-18);
  EXPECT_DOUBLE_EQ(three.weight[1], 8.0 / 9.0);
}

TEST(GaussLegendre, LagrangePolynomialsAreOneAtTheirPlaceAndZeroAtTheOthers) {
  constexpr auto rule = gaussLegendre<7>(0.0, 1.0);
  constexpr auto all = lagrangePolynomials(rule.node);
  for (std::size_t k = 0; k < 7; ++k) {
    for (std::size_t j = 0; j < 7; ++j) {
      double value = 0.0;
      for (std::size_t i = 7; i-- > 0;) value = value * rule.node[j] + all[k][i];
      EXPECT_NEAR(value, k == j ? 1.0 : 0.0, 1e-11);
    }
  }
}

}  // namespace
