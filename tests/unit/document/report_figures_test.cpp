// SPDX-License-Identifier: GPL-3.0-or-later
// What the plots of the printed report show.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/curve/arc_length.h"
#include "core/document/report_pages/curve_figures.h"
#include "core/fairing/fairing.h"
#include "tests/support/clamped_knots.h"

namespace batten {
namespace {

/// A clamped quintic with even knots through a polygon.
NurbsCurve quintic(std::vector<Vec2> points) {
  const int count = static_cast<int>(points.size());
  return NurbsCurve::make(5, test::clampedUnitKnots(5, count), std::move(points)).value();
}

/// A wave that is not quite fair.
NurbsCurve wave() {
  std::vector<Vec2> points;
  for (int i = 0; i <= 40; ++i) {
    const double x = 5.0 * i;
    points.emplace_back(x, 12.0 * std::sin(x / 32.0) + 0.15 * std::sin(x / 4.0));
  }
  return quintic(points);
}

TracedCurve fairedTo(const NurbsCurve& start, int degree) {
  TracedCurve curve;
  curve.sketched = start;
  curve.fairingUsed.mode = FairingMode::Target;
  curve.fairingUsed.target = targetOfDegree(degree);
  curve.fairingUsed.toleranceMm = 1.0;
  auto faired = fair(start, false, curve.fairingUsed, {});
  EXPECT_TRUE(faired) << faired.error().message;
  curve.faired = faired->curve;
  curve.fairing = faired->report;
  return curve;
}

/// rms difference of a profile and the curvature of a curve, by the range of that.
double misfit(const TargetProfile& profile, const NurbsCurve& curve) {
  const auto samples = sampleByArcLength(curve, 401);
  double sum = 0.0, low = 1e9, high = -1e9;
  for (const CurveSample& sample : samples) {
    const double off = profile.curvatureAt(sample.s / samples.back().s) - sample.kappa;
    sum += off * off;
    low = std::min(low, sample.kappa);
    high = std::max(high, sample.kappa);
  }
  return std::sqrt(sum / static_cast<double>(samples.size())) / (high - low);
}

TEST(ReportFigures, TheTargetIsTheOneThatTheCurveFollowed) {
  const TracedCurve chosen = fairedTo(wave(), 3);
  ASSERT_TRUE(chosen.fairing.withinTolerance) << "the tolerance is wide";
  EXPECT_EQ(chosen.fairing.targetDegree, 3);
  EXPECT_GE(chosen.fairing.targetSplits.size(), 2u) << "a polynomial from extremum to extremum";
  const auto target = targetOf(chosen);
  ASSERT_TRUE(target);
  const double off = misfit(*target, chosen.faired);
  EXPECT_LT(off, 0.04);
  const TargetSet whole = fitTargets(chosen.fairingStart(), chosen.fairingUsed.targets, false);
  EXPECT_GT(misfit(whole.profiles[2], chosen.faired), 3.0 * off) << "one monotone polynomial cannot follow a wave";
  // The recommended degree is the one that was taken.
  const TracedCurve recommended = fairedTo(wave(), 0);
  ASSERT_TRUE(recommended.fairing.targetDegree);
  EXPECT_EQ(targetOf(recommended)->degree, recommended.fairing.targetDegree);
  EXPECT_LT(misfit(*targetOf(recommended), recommended.faired), 0.1);
}

TEST(ReportFigures, TheTargetOfASpanIsTheCurveItselfElsewhere) {
  TracedCurve curve;
  curve.sketched = wave();
  curve.fairingUsed.mode = FairingMode::Target;
  curve.fairingUsed.toleranceMm = 1.0;
  curve.fairingUsed.spanTargets = {{0.3, 2}};
  auto faired = fair(curve.sketched, false, curve.fairingUsed, {});
  ASSERT_TRUE(faired);
  curve.faired = faired->curve;
  curve.fairing = faired->report;
  const auto target = targetOf(curve);
  ASSERT_TRUE(target);
  const auto samples = sampleByArcLength(curve.sketched, 401);
  constexpr double kSampled = 0.01 * 0.018;  // of the largest curvature: the profile is a table of 121 places
  for (const CurveSample& sample : samples) {
    const double f = sample.s / samples.back().s;
    if (f < 0.8 || f > 0.97) continue;  // behind the span, which ends at three quarters
    EXPECT_NEAR(target->curvatureAt(f), sample.kappa, kSampled) << f;
  }
}

TEST(ReportFigures, TheNumbersOfTheAxesNeverLieOverOneAnother) {
  for (const double bend : {0.0, 0.02, 0.5, 3.0, 8.0}) {
    std::vector<Vec2> points;
    for (int i = 0; i <= 30; ++i) {
      const double x = 4.0 * i;
      points.emplace_back(x, 20.0 * std::sin(x / 20.0) + bend * std::exp(-std::pow((x - 60.0) / 6.0, 2.0)));
    }
    TracedCurve curve;
    curve.sketched = quintic(points);
    const Figure figure = radiusFigure(curve, std::nullopt, 96.0, 50.0);
    int numbers = 0;
    for (std::size_t i = 0; i < figure.texts.size(); ++i) {
      const FigureText& a = figure.texts[i];
      numbers += a.anchor == FigureText::Anchor::End ? 1 : 0;
      for (std::size_t k = 0; k < i; ++k) {
        const FigureText& b = figure.texts[k];
        const bool isColumn = a.anchor != FigureText::Anchor::Middle && b.anchor != FigureText::Anchor::Middle;
        if (isColumn) {
          EXPECT_GE(std::abs(a.at.y() - b.at.y()), a.heightMm) << bend << ": " << a.text << " and " << b.text;
        }
      }
    }
    EXPECT_GE(numbers, 2) << bend;
  }
}

}  // namespace
}  // namespace batten
