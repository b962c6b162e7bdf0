// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

/// A course made of a random turning: bends, inflections and straight parts, with noise on the control points.
NurbsCurve randomOpen(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const int count = 6 + static_cast<int>(uniform(random) * 55), degree = uniform(random) < 0.7 ? 5 : 3;
  const double length = 20.0 + 300.0 * uniform(random), bend = 3.0 * uniform(random) * uniform(random);
  const double wave = 6.0 * uniform(random), phase = 6.0 * uniform(random),
               noise = 0.5 * std::pow(uniform(random), 3.0);
  std::normal_distribution<double> normal(0.0, noise);
  std::vector<Vec2> points;
  Vec2 at(uniform(random) * 100.0, uniform(random) * 100.0);
  double angle = 6.28 * uniform(random);
  for (int j = 0; j < count; ++j) {
    points.push_back(at + Vec2(normal(random), normal(random)));
    const double f = static_cast<double>(j) / count;
    angle += bend / count * (0.3 + std::sin(wave * f + phase)) * (f > 0.4 && f < 0.6 ? 0.0 : 1.0);
    at += length / count * Vec2(std::cos(angle), std::sin(angle));
  }
  return NurbsCurve::make(degree, test::clampedKnots(degree, count), points).value();
}

NurbsCurve randomClosed(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const int count = 8 + static_cast<int>(uniform(random) * 30);
  const double a = 20.0 + 100.0 * uniform(random), b = a * (0.4 + 0.6 * uniform(random)),
               noise = 0.01 * uniform(random);
  std::normal_distribution<double> normal(0.0, noise);
  std::vector<double> radius;
  for (int j = 0; j < count; ++j) radius.push_back(1.0 + normal(random));
  return test::closedCurve(
      [&](double f) {
        const double r = radius[std::lround(f * count) % radius.size()];
        return Vec2(a * r * std::cos(2.0 * std::numbers::pi * f), b * r * std::sin(2.0 * std::numbers::pi * f));
      },
      count);
}

void expectSound(const NurbsCurve& start, bool closed, const FairedCurve& faired, double tolerance) {
  const double size = extent(start);
  EXPECT_LE(deviation(faired.curve, start).max, tolerance * (1.0 + 1e-6));
  EXPECT_LE(faired.report.maxDeviationMm, tolerance);
  for (const Vec2& q : faired.curve.controlPoints()) EXPECT_TRUE(q.allFinite());
  EXPECT_TRUE(std::isfinite(faired.report.objectiveAfter) && std::isfinite(faired.report.neededMm.value_or(0.0)));
  EXPECT_NE(faired.report.why, Termination::NotRun);
  if (!closed) {
    EXPECT_LT((faired.curve.point(start.start()) - start.point(start.start())).norm(), 1e-9 * size);
    EXPECT_LT((faired.curve.point(start.end()) - start.point(start.end())).norm(), 1e-9 * size);
    return;
  }
  const auto a = faired.curve.derivatives(faired.curve.start(), 4), b = faired.curve.derivatives(faired.curve.end(), 4);
  double scale = size;
  for (std::size_t d = 0; d <= 4; ++d) {
    EXPECT_LT((a[d] - b[d]).norm(), 1e-9 * scale) << "derivative " << d;
    scale *= start.controlPointCount();
  }
}

TEST(RandomCurves, AreFairedWithinTheToleranceInEveryMode) {
  constexpr std::array kModes = {FairingMode::Target, FairingMode::Tolerance, FairingMode::Monotone,
                                 FairingMode::LowPass};
  std::mt19937 random(20240607);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const bool closed = i % 5 == 4;
    const NurbsCurve curve = closed ? randomClosed(random) : randomOpen(random);
    FairingParams params;
    params.mode = kModes[i % kModes.size()];
    params.keepExtrema = keptExtremaOf(i / 4 % 5 - 1);
    params.lowPassMm = std::pow(10.0, 2.5 * uniform(random));
    if (i % 3 == 0) params.targets.splits = {0.3 + 0.4 * uniform(random)};
    params.target = *targetOfNumber(i % 7);
    params.toleranceMm = 0.01 * std::pow(100.0, uniform(random));
    params.targets.monotone = i % 3 != 0;
    params.startHold = {i % 11 == 0, i % 13 == 0};
    SCOPED_TRACE("curve " + std::to_string(i) + " of " + std::to_string(curve.controlPointCount()) + " points");
    const auto faired = fair(curve, closed, params, {});
    ASSERT_TRUE(faired) << faired.error().message;
    expectSound(curve, closed, *faired, params.toleranceMm);
  }
}

TEST(RandomCurves, TargetsAreTheSameWithAnyNumberOfThreads) {
  std::mt19937 random(5);
  const NurbsCurve curve = randomOpen(random);
  RunContext one, two;
  one.threads = 1;
  two.threads = 3;
  const auto a = fairAllTargets(curve, false, {}, one), b = fairAllTargets(curve, false, {}, two);
  ASSERT_TRUE(a && b);
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_EQ(a->faired[i].has_value(), b->faired[i].has_value());
    if (a->faired[i]) {
      EXPECT_EQ(a->faired[i]->curve, b->faired[i]->curve);
    }
  }
}

}  // namespace
}  // namespace batten
