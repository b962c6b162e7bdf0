// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/curve_fairness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/curve/curvature.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

/// A line whose curvature over its share of the length is given.
template <class Curvature>
NurbsCurve lineOf(Curvature kappa, double length = 200.0, int count = 40) {
  constexpr int kSteps = 4000;
  std::vector<Vec2> course{Vec2::Zero()};
  double angle = 0.0;
  for (int j = 0; j < kSteps; ++j) {
    const double f = (j + 0.5) / kSteps, turn = kappa(f) * length / kSteps;
    const double middle = angle + 0.5 * turn;
    course.push_back(course.back() + length / kSteps * Vec2(std::cos(middle), std::sin(middle)));
    angle += turn;
  }
  const auto at = [&](double t) {
    const double x = kSteps * t;
    const int i = static_cast<int>(std::clamp(std::floor(x), 0.0, kSteps - 1.0));
    return Vec2(course[i] + (x - static_cast<double>(i)) * (course[i + 1] - course[i]));
  };
  return test::fitted(at, count);
}

TEST(CurveFairness, NearestRisingIsNearerThanAnyOther) {
  std::mt19937 random(77);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> values;
    for (int i = 0; i < 12; ++i) values.push_back(0.2 * i + normal(random));
    const auto nearest = nearestRising(values);
    ASSERT_EQ(nearest.size(), values.size());
    EXPECT_TRUE(std::is_sorted(nearest.begin(), nearest.end()));
    const auto misfit = [&](const std::vector<double>& other) {
      double sum = 0.0;
      for (std::size_t i = 0; i < values.size(); ++i) sum += (other[i] - values[i]) * (other[i] - values[i]);
      return sum;
    };
    const double least = misfit(nearest);
    for (int k = 0; k < 200; ++k) {
      std::vector<double> other = nearest;
      for (double& v : other) v += 0.1 * normal(random);
      std::sort(other.begin(), other.end());
      EXPECT_GE(misfit(other), least - 1e-12);
    }
  }
}

TEST(CurveFairness, AClothoidIsMonotoneAndLogAesthetic) {
  const auto fairness = curveFairness(lineOf([](double f) { return 0.004 + 0.016 * f; }), false);
  ASSERT_TRUE(fairness);
  EXPECT_GT(fairness->similarity, 0.9999);
  ASSERT_TRUE(fairness->logAesthetic);
  EXPECT_GT(*fairness->logAesthetic, 0.999);
  ASSERT_TRUE(fairness->alpha);
  EXPECT_NEAR(*fairness->alpha, -1.0, 0.1);
  EXPECT_EQ(fairness->extrema, 0);
}

TEST(CurveFairness, FallsWithEveryBump) {
  double before = 1.1;
  for (const double height : {0.0, 0.004, 0.010}) {
    const auto fairness = curveFairness(
        lineOf([&](double f) { return 0.01 + 0.004 * f + height * std::sin(6.0 * std::numbers::pi * f); }), false);
    ASSERT_TRUE(fairness);
    EXPECT_LT(fairness->similarity, before);
    EXPECT_GE(fairness->similarity, fairness->logAesthetic.value_or(0.0) - 1e-6) << "log-aesthetic curves are monotone";
    EXPECT_EQ(fairness->extrema, height > 0.0 ? 6 : 0);
    before = fairness->similarity;
  }
  EXPECT_LT(before, 0.97);
}

TEST(CurveFairness, AnEllipseIsAsFairAsAClosedCurveCanBe) {
  const auto oval = [](double wave) {
    return test::closedCurve(
        [wave](double t) {
          const double a = 2.0 * std::numbers::pi * t;
          return Vec2((1.0 + wave * std::sin(9.0 * a)) * Vec2(60.0 * std::cos(a), 40.0 * std::sin(a)));
        },
        48);
  };
  const NurbsCurve ellipse = oval(0.0), wavy = oval(0.01);
  const auto fair = curveFairness(ellipse, true), bumpy = curveFairness(wavy, true);
  ASSERT_TRUE(fair && bumpy);
  EXPECT_GT(fair->similarity, 0.9995);
  EXPECT_EQ(fair->extrema, 4);
  EXPECT_LT(bumpy->similarity, 0.97);
  EXPECT_GT(bumpy->extrema, 10);
}

TEST(CurveFairness, StraightLinesAndNothing) {
  const auto line = NurbsCurve::make(1, {0.0, 0.0, 1.0, 1.0}, {Vec2(0, 0), Vec2(30, 10)});
  ASSERT_TRUE(line);
  const auto fairness = curveFairness(*line, false);
  ASSERT_TRUE(fairness);
  EXPECT_EQ(fairness->similarity, 1.0);
  EXPECT_EQ(fairness->extrema, 0);
  EXPECT_EQ(fairness->controlPoints, 2);
  EXPECT_FALSE(fairness->alpha);
  EXPECT_FALSE(curveFairness(NurbsCurve(), false));
}

}  // namespace
}  // namespace batten
