// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/log_aesthetic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/curve/curvature.h"
#include "core/fairing/fairing.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

/// Radius over the arc length by its definition: rho^alpha linear; integrated by fine steps.
std::vector<Vec2> spiral(double alpha, double rho0, double rho1, double length, int steps) {
  std::vector<Vec2> points{Vec2::Zero()};
  double angle = 0.0;
  const double ds = length / steps;
  for (int i = 0; i < steps; ++i) {
    const double x = (i + 0.5) / steps;
    const double rho =
        alpha == 0.0
            ? rho0 * std::pow(rho1 / rho0, x)
            : std::pow(std::pow(rho0, alpha) + (std::pow(rho1, alpha) - std::pow(rho0, alpha)) * x, 1.0 / alpha);
    const double turn = ds / rho;
    angle += 0.5 * turn;
    points.push_back(points.back() + ds * Vec2(std::cos(angle), std::sin(angle)));
    angle += 0.5 * turn;
  }
  return points;
}

NurbsCurve spiralCurve(double alpha) {
  const auto points = spiral(alpha, 150.0, 45.0, 120.0, 20000);
  return test::fitted([&](double t) { return points[std::lround(t * 20000.0)]; }, 20);
}

TEST(LogAesthetic, FindsTheAlphaOfASpiral) {
  for (const double alpha : {-1.0, 0.0, 0.5, 1.0, 2.0}) {
    const auto target = logAestheticTarget(spiralCurve(alpha), false, {}, {}, 241);
    ASSERT_TRUE(target.profile.valid);
    ASSERT_EQ(target.spans.size(), 1u);
    const LogAestheticSpan& span = target.spans.front();
    EXPECT_NEAR(span.alpha, alpha, 0.05);
    EXPECT_NEAR(span.startRadiusMm.value(), 150.0, 1.0);
    EXPECT_NEAR(span.endRadiusMm.value(), 45.0, 0.5);
    // rho^alpha = rho0^alpha (1 + alpha Lambda s / rho0) at the end.
    const double grown = alpha == 0.0 ? std::exp(span.lambda * 120.0 / 150.0)
                                      : std::pow(1.0 + alpha * span.lambda * 120.0 / 150.0, 1.0 / alpha);
    if (std::abs(span.alpha - alpha) < 0.02) {
      EXPECT_NEAR(150.0 * grown, 45.0, 3.0) << alpha;
    }
    EXPECT_GT(target.profile.similarity, 0.9999);
  }
}

TEST(LogAesthetic, ItsSlopeIsTheDerivativeOfItsCurvature) {
  for (const double alpha : {-2.0, -1.0, 0.0, 0.7, 3.0}) {
    const LogAesthetic one{0.01, 0.03, alpha};
    EXPECT_NEAR(one.kappa(0.0), 0.01, 1e-12);
    EXPECT_NEAR(one.kappa(1.0), 0.03, 1e-12);
    for (double x = 0.1; x < 1.0; x += 0.2)
      EXPECT_NEAR(one.slope(x), (one.kappa(x + 1e-6) - one.kappa(x - 1e-6)) / 2e-6, 1e-7);
  }
}

TEST(LogAesthetic, AnInflectionIsAClothoid) {
  const auto target = logAestheticTarget(test::wave(100.0, 3.0, 30), false, {0.25, 0.75}, {}, 241);
  ASSERT_EQ(target.spans.size(), 3u);
  EXPECT_EQ(target.spans[1].alpha, -1.0);
  EXPECT_EQ(target.profile.nodes.front().f, 0.0);
  EXPECT_NEAR(target.profile.nodes.back().f, 1.0, 1e-12);
  for (const ProfileNode& node : target.profile.nodes) EXPECT_TRUE(std::isfinite(node.value + node.slope));
}

TEST(LogAesthetic, FairsWithinTheToleranceAndReportsItsSpans) {
  const NurbsCurve sketch = test::noisy(spiralCurve(0.5), 0.03, 11);
  FairingParams params;
  params.mode = FairingMode::Target;
  params.target = FairingTarget::LogAesthetic;
  params.targets.spans = TargetSpans::Whole;
  params.toleranceMm = 0.5;
  const auto faired = fair(sketch, false, params, {});
  ASSERT_TRUE(faired) << faired.error().message;
  EXPECT_LE(faired->report.maxDeviationMm, 0.5);
  EXPECT_LT(countedExtrema(faired->curve, false), countedExtrema(sketch, false));
  ASSERT_EQ(faired->report.logAesthetic.size(), 1u);
  EXPECT_NEAR(faired->report.logAesthetic.front().alpha, 0.5, 0.6);
  params.alpha = 1.0;
  const auto asked = fair(sketch, false, params, {});
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->report.logAesthetic.front().alpha, 1.0);
  params.alpha = 7.0;
  EXPECT_TRUE(validate(params));
}

}  // namespace
}  // namespace batten
