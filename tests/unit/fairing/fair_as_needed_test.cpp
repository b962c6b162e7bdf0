// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing.h"
#include "core/fairing/model/fairing_line.h"
#include "tests/support/growth.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

FairingParams tolerance(double mm, TolerancePolicy tolerancePolicy = TolerancePolicy::AsNeeded) {
  FairingParams params;
  params.mode = FairingMode::Tolerance;
  params.toleranceMm = mm;
  params.tolerancePolicy = tolerancePolicy;
  return params;
}

/// Points about 1 apart on a curve, with white noise across it.
FairingLine measured(const NurbsCurve& truth, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, sigma);
  FairingLine line;
  line.pixelMm = 1.0;
  const int count = static_cast<int>(ArcLength(truth).total()) + 1;
  for (const CurveSample& s : sampleByArcLength(truth, count)) {
    line.points.push_back(s.point + normal(random) * leftNormal(s.tangent));
  }
  return line;
}

int extremaOf(const NurbsCurve& curve) {
  return static_cast<int>(curvatureExtrema(curve, 5e-3 / extent(curve), false).size());
}

TEST(FairAsNeeded, ComesNearerToTheTruthWhateverTheTolerance) {
  const NurbsCurve truth = test::ellipseQuarter(300, 180, 20);
  for (const unsigned seed : {1u, 2u, 3u}) {
    const NurbsCurve sketch = test::noisy(truth, 0.15, seed);
    ASSERT_GT(extremaOf(sketch), 4);
    const FairingLine line = measured(truth, 0.3, seed);
    for (const double mm : {0.5, 2.0, 10.0}) {
      SCOPED_TRACE(std::to_string(seed) + ", tolerance " + std::to_string(mm));
      const auto faired = fair(sketch, false, tolerance(mm), {}, line);
      ASSERT_TRUE(faired) << faired.error().message;
      EXPECT_LE(faired->report.maxDeviationMm, mm);
      EXPECT_LE(deviation(sketch, faired->curve).max, mm);
      EXPECT_EQ(extremaOf(faired->curve), extremaOf(truth));
      EXPECT_LT(deviation(truth, faired->curve).rms, 0.06);
      EXPECT_LT(deviation(truth, faired->curve).rms, 0.8 * deviation(truth, sketch).rms);
      // Means of 8 points of noise 0.3.
      EXPECT_NEAR(faired->report.noiseMm.value(), 0.3 / std::sqrt(8.0), 0.035);
      EXPECT_EQ(faired->report.why, Termination::Converged);
    }
  }
}

TEST(FairAsNeeded, KeepsABumpThatThePointsProve) {
  // A bump of 1 on a flat arc: the whole tolerance would level it. The sketch shakes by 0.1 in short waves.
  const auto shape = [](double t, double shake) {
    const double bump = std::exp(-std::pow((t - 0.5) / 0.08, 2));
    const double waves = std::sin(2.0 * std::numbers::pi * 9.0 * t) + std::sin(2.0 * std::numbers::pi * 14.0 * t);
    return Vec2(400.0 * t, 40.0 * t * (1.0 - t) + bump + shake * waves);
  };
  const NurbsCurve truth = test::fitted([&](double t) { return shape(t, 0.0); }, 40);
  const NurbsCurve sketch = test::fitted([&](double t) { return shape(t, 0.05); }, 40);
  const int bumps = extremaOf(truth);
  ASSERT_EQ(bumps, 3);
  ASSERT_GT(extremaOf(sketch), 10);
  int tooMany = 0;
  // With 44 the curvature turns twice within a part of the first span where the curve is slow.
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 44u}) {
    SCOPED_TRACE(seed);
    const FairingLine line = measured(truth, 0.2, seed);
    const auto needed = fair(sketch, false, tolerance(3.0), {}, line);
    ASSERT_TRUE(needed);
    EXPECT_GE(extremaOf(needed->curve), bumps);
    EXPECT_LT(deviation(truth, needed->curve).rms, 0.05);
    tooMany += extremaOf(needed->curve) - bumps;
  }
  // One weight for bump and flat parts alike leaves a few waves in these: one a curve, of more than seven.
  EXPECT_LE(tooMany, 6);
  const auto all = fair(sketch, false, tolerance(3.0, TolerancePolicy::All), {});
  ASSERT_TRUE(all);
  EXPECT_LT(extremaOf(all->curve), bumps);
}

TEST(FairAsNeeded, WithoutPointsMovesLessThanTheWholeToleranceForAsFewExtrema) {
  const NurbsCurve sketch = test::noisy(test::wave(300, 20, 40), 0.05, 7);
  const auto needed = fair(sketch, false, tolerance(1.0), {});
  const auto all = fair(sketch, false, tolerance(1.0, TolerancePolicy::All), {});
  ASSERT_TRUE(needed && all);
  EXPECT_LE(needed->report.extremaAfter, all->report.extremaAfter);
  EXPECT_LT(needed->report.extremaAfter, needed->report.extremaBefore);
  EXPECT_LT(needed->report.maxDeviationMm, 0.7 * all->report.maxDeviationMm);
  EXPECT_FALSE(needed->report.noiseMm);
}

TEST(FairAsNeeded, KeepsATightToleranceAndClosedCurves) {
  const NurbsCurve truth = test::closedCurve(
      [](double f) {
        const double a = 2.0 * std::numbers::pi * f;
        return Vec2(120.0 * std::cos(a), 80.0 * std::sin(a));
      },
      24);
  const FairingLine line = measured(truth, 0.2, 11);
  for (const double mm : {0.02, 1.0}) {
    const auto faired = fair(truth, true, tolerance(mm), {}, line);
    ASSERT_TRUE(faired) << faired.error().message;
    EXPECT_LE(faired->report.maxDeviationMm, mm);
    const NurbsCurve& c = faired->curve;
    EXPECT_LT((c.point(c.start()) - c.point(c.end())).norm(), 1e-9 * extent(c));
    EXPECT_LE(faired->report.extremaAfter, std::max(4, faired->report.extremaBefore));
  }
}

// Hundreds of segments follow the noise: each step of the search for a simpler curve has to do with all of them.
TEST(FairAsNeeded, AStepTakesNoTimeWithTheSquareOfTheSegments) {
  const auto secondsAStep = [](int points) {
    std::vector<Vec2> control;
    for (int i = 0; i < points; ++i) {
      const double t = 3.0 * i / (points - 1);
      control.emplace_back(300.0 * std::cos(t), 180.0 * std::sin(t));
    }
    const NurbsCurve truth = NurbsCurve::make(5, test::clampedKnots(5, points), control).value();
    const NurbsCurve sketch = test::noisy(truth, 0.02, 1);
    const FairingLine line = measured(truth, 0.3, 1);
    int steps = 1;
    const double seconds = test::secondsOf([&] {
      const auto faired = fair(sketch, false, tolerance(1.0), {}, line);
      ASSERT_TRUE(faired && faired->report.iterations > 0);
      steps = faired->report.iterations;
    });
    return seconds / steps;
  };
  EXPECT_TRUE(test::growsAtMost(
      3.0 * 4.0, [&] { return secondsAStep(75); }, [&] { return secondsAStep(300); }))
      << "4 times the segments; 16 times and more if each looked at all of them";
}

}  // namespace
}  // namespace batten
