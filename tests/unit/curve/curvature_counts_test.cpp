// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/curve/curvature.h"
#include "tests/support/clamped_knots.h"

namespace batten {
namespace {

TEST(CurvatureCounts, AreThoseOfThePlacesFound) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec2> points;
    for (int i = 0; i < 14; ++i) points.emplace_back(10.0 * i + 3.0 * any(random), 20.0 * any(random));
    const auto curve = NurbsCurve::make(5, test::clampedUnitKnots(5, 14), points);
    ASSERT_TRUE(curve);
    for (const double prominence : {1e-4, 1e-2}) {
      const CurvatureCounts counts = curvatureCounts(*curve, prominence, false);
      EXPECT_EQ(counts.extrema, std::ssize(curvatureExtrema(*curve, prominence, false)));
      EXPECT_EQ(counts.inflections, std::ssize(inflections(*curve, prominence, false)));
    }
  }
}

TEST(CurvatureCounts, GoAroundAClosedCurve) {
  // A circle whose radius swings five times by a quarter: ten extrema and, bent inwards between the lobes, ten
  // inflections. As a periodic cubic through many points of it.
  constexpr int kControlPoints = 240;
  std::vector<Vec2> points;
  std::vector<double> knots;
  for (int i = 0; i < kControlPoints + 5; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kControlPoints,
                 radius = 100.0 * (1.0 + 0.25 * std::cos(5.0 * angle));
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  for (int i = 0; i < kControlPoints + 11; ++i) knots.push_back(i);
  const auto curve = NurbsCurve::make(5, knots, points);
  ASSERT_TRUE(curve);
  const CurvatureCounts counts = curvatureCounts(*curve, 1e-4, true);
  EXPECT_EQ(counts.extrema, 10);
  EXPECT_EQ(counts.inflections, 10);
}

}  // namespace
}  // namespace batten
