// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/curve/span_curve.h"
#include "tests/support/clamped_knots.h"

namespace batten {
namespace {

constexpr int kControlPoints = 24, kDegree = 5;

/// A line whose speed all but vanishes in places, as where fairing has drawn control points together.
std::vector<Vec2> unevenPoints(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Vec2> points{Vec2::Zero()};
  while (std::ssize(points) < kControlPoints) {
    const double step = std::pow(10.0, -2.5 * uniform(random));
    points.push_back(points.back() + Vec2(step, 0.3 * step * (uniform(random) - 0.5)));
  }
  return points;
}

TEST(FootPoint, IsNeverFartherThanWhereTheSearchBegan) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int missed = 0;
  const std::vector<double> knots = test::clampedUnitKnots(kDegree, kControlPoints);
  const SpanBasis basis(kDegree, knots, kControlPoints, 0);
  for (int line = 0; line < 200; ++line) {
    const SpanCurve curve(basis, unevenPoints(random));
    for (int k = 0; k < 50; ++k) {
      const SpanPlace there{static_cast<int>(uniform(random) * basis.spanCount()), uniform(random)};
      const SpanPlace start = basis.place(basis.parameter(there) + uniform(random) - 0.5);
      const Vec2 point = curve.at(there, 0)[0] + 0.02 * Vec2(0.0, uniform(random) - 0.5);
      const SpanPlace foot = footPoint(curve, point, start);
      const double away = (curve.at(foot, 0)[0] - point).norm();
      EXPECT_LE(away, (curve.at(start, 0)[0] - point).norm() * (1.0 + 1e-9)) << "line " << line << ", point " << k;
      // 0.01 off the line at most, which goes on to the right all the way: no foot is much farther.
      if (away > 0.0101) ++missed;
    }
  }
  EXPECT_EQ(missed, 0) << "of 10000 points";
}

TEST(FootPoint, ThatIsNearEnoughEndsTheSearch) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const std::vector<double> knots = test::clampedUnitKnots(kDegree, kControlPoints);
  const SpanBasis basis(kDegree, knots, kControlPoints, 0);
  const SpanCurve curve(basis, unevenPoints(random));
  for (int k = 0; k < 500; ++k) {
    const SpanPlace there{static_cast<int>(uniform(random) * basis.spanCount()), uniform(random)};
    const SpanPlace start = basis.place(basis.parameter(there) + uniform(random) - 0.5);
    const Vec2 point = curve.at(there, 0)[0] + 0.02 * Vec2(0.0, uniform(random) - 0.5);
    const auto distanceOf = [&](const SpanPlace& place) { return (curve.at(place, 0)[0] - point).norm(); };
    const double least = distanceOf(footPoint(curve, point, start)), enough = 0.1 * uniform(random);
    const double found = distanceOf(footPoint(curve, point, start, enough));
    EXPECT_LE(found, std::max(enough, least) * (1.0 + 1e-9)) << "point " << k;
    if (distanceOf(start) <= enough) {
      EXPECT_EQ(found, distanceOf(start)) << "point " << k;
    }
  }
}

TEST(FootPoint, IsFoundAlsoOverManySpans) {
  std::mt19937 random(12);
  const std::vector<double> knots = test::clampedUnitKnots(kDegree, kControlPoints);
  const SpanBasis basis(kDegree, knots, kControlPoints, 0);
  std::vector<Vec2> points;
  for (int i = 0; i < kControlPoints; ++i) points.emplace_back(i, 2.0 * std::sin(0.2 * i));
  const SpanCurve curve(basis, points);
  for (int span = 0; span < basis.spanCount(); ++span) {
    const Vec2 point = curve.at({span, 0.5}, 0)[0];
    for (int from = std::max(0, span - 3); from <= std::min(basis.spanCount() - 1, span + 3); ++from) {
      const SpanPlace foot = footPoint(curve, point, {from, 0.3});
      EXPECT_NEAR(basis.parameter(foot), basis.parameter({span, 0.5}), 1e-7) << "from span " << from;
    }
  }
}

}  // namespace
}  // namespace batten
