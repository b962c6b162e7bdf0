// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/cubic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/curve/bernstein.h"

namespace batten {
namespace {

const CubicBezier kWave = {Vec2(1.0, -2.0), Vec2(4.0, 5.0), Vec2(6.0, -3.0), Vec2(9.0, 1.0)};

/// De Casteljau: halving the polygon, no polynomial written out.
Vec2 byDeCasteljau(CubicBezier c, double t) {
  for (int level = 3; level > 0; --level)
    for (int i = 0; i < level; ++i) c[i] = (1.0 - t) * c[i] + t * c[i + 1];
  return c[0];
}

TEST(Cubic, PointAndDerivativesAreThoseOfDeCasteljau) {
  constexpr double kStep = 1e-4;
  for (const double t : {0.0, 0.2, 0.5, 0.77, 1.0}) {
    const Vec2 here = byDeCasteljau(kWave, t), before = byDeCasteljau(kWave, t - kStep),
               behind = byDeCasteljau(kWave, t + kStep);
    EXPECT_LT((cubicPoint(kWave, t) - here).norm(), 1e-14) << t;
    EXPECT_LT((cubicFirst(kWave, t) - (behind - before) / (2.0 * kStep)).norm(), 1e-6) << t;
    EXPECT_LT((cubicSecond(kWave, t) - (behind - 2.0 * here + before) / (kStep * kStep)).norm(), 1e-5) << t;
  }
}

TEST(Cubic, TheFootIsTheNearestOfManyPlaces) {
  for (const Vec2& p : {Vec2(2.0, 2.0), Vec2(5.0, 0.0), Vec2(8.0, -2.0)}) {
    constexpr int kPlaces = 20000;
    double least = std::numeric_limits<double>::infinity(), nearest = 0.0;
    for (int i = 0; i <= kPlaces; ++i) {
      const double t = static_cast<double>(i) / kPlaces, d = (byDeCasteljau(kWave, t) - p).norm();
      if (d < least) least = d, nearest = t;
    }
    EXPECT_NEAR(cubicFoot(kWave, p, nearest + 0.03, 8), nearest, 2.0 / kPlaces);
    EXPECT_EQ(cubicFoot(kWave, p, 0.4, 0), 0.4) << "no round, no step";
  }
}

TEST(Cubic, TheFootStaysWithinTheCurve) {
  EXPECT_EQ(cubicFoot(kWave, Vec2(-5.0, -10.0), 0.1, 20), 0.0);
  const CubicBezier point = {Vec2(1.0, 1.0), Vec2(1.0, 1.0), Vec2(1.0, 1.0), Vec2(1.0, 1.0)};
  EXPECT_EQ(cubicFoot(point, Vec2(3.0, 0.0), 0.5, 8), 0.5) << "a curve that stands still";
}

TEST(Bernstein, PolynomialsAreBinomialTerms) {
  for (int degree = 0; degree <= kMostBernsteinDegree; ++degree) {
    for (const double t : {0.0, 0.3, 0.9, 1.0}) {
      const auto values = bernsteinPolynomials(degree, t);
      for (int k = 0; k <= kMostBernsteinDegree; ++k) {
        const double choose = std::tgamma(degree + 1.0) / (std::tgamma(k + 1.0) * std::tgamma(degree - k + 1.0));
        const double term = k > degree ? 0.0 : choose * std::pow(t, k) * std::pow(1.0 - t, degree - k);
        EXPECT_NEAR(values[k], term, 1e-14) << degree << ' ' << k;
      }
    }
  }
}

}  // namespace
}  // namespace batten
