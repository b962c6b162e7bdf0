// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/natural_spans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/curvature_structure.h"
#include "core/fairing/fairing.h"
#include "core/fairing/target/span_fairing.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

/// A line of a given curvature over the share of its length, by plain integration.
NurbsCurve fromCurvature(const std::function<double(double)>& kappa, double length, int controlPoints) {
  constexpr int kSteps = 4000;
  std::vector<Vec2> course{Vec2::Zero()};
  double angle = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = angle + 0.5 * length / kSteps * kappa((i + 0.5) / kSteps);
    course.push_back(course.back() + length / kSteps * Vec2(std::cos(middle), std::sin(middle)));
    angle += length / kSteps * kappa((i + 0.5) / kSteps);
  }
  return test::fitted(
      [&](double t) {
        const double x = t * kSteps, below = std::min(std::floor(x), kSteps - 1.0);
        const int i = static_cast<int>(below);
        return Vec2(course[i] + (x - below) * (course[i + 1] - course[i]));
      },
      controlPoints);
}

double bump(double f, double at, double width) { return std::exp(-(f - at) * (f - at) / (width * width)); }

/// Two bumps that are seen, at .25 and .75, with the dip between them, and a trifle at .5.
NurbsCurve twoBumps(double trifle) {
  return fromCurvature(
      [=](double f) {
        return 0.01 + 0.03 * bump(f, 0.25, 0.08) + 0.02 * bump(f, 0.75, 0.08) + trifle * bump(f, 0.5, 0.01);
      },
      80.0, 80);
}

FairingParams toTarget(int degree, double tolerance) {
  FairingParams params;
  params.mode = FairingMode::Target;
  params.target = targetOfDegree(degree);
  params.toleranceMm = tolerance;
  return params;
}

TEST(NaturalSplits, LieAtTheExtremaThatCanBeSeen) {
  const std::vector<double> splits = naturalSplits(twoBumps(0.0), false, 0.2);
  ASSERT_EQ(splits.size(), 3u);
  EXPECT_NEAR(splits[0], 0.25, 0.01);
  EXPECT_NEAR(splits[1], 0.5, 0.03);
  EXPECT_NEAR(splits[2], 0.75, 0.01);
}

TEST(NaturalSplits, TriflesCountForSmallTolerancesOnly) {
  // Height .001 over a half wave of 1 mm: 5e-5 mm to remove.
  const NurbsCurve line = twoBumps(0.001);
  EXPECT_EQ(naturalSplits(line, false, 0.2).size(), 3u);
  EXPECT_EQ(naturalSplits(line, false, 0.001).size(), 5u);
  EXPECT_TRUE(naturalSplits(line, false, 20.0).size() < 3u) << "all of it moves the curve by less than 2 mm";
  const auto levels = naturalSpanLevels(line, false);
  for (std::size_t i = 1; i < levels.size(); ++i) EXPECT_GT(levels[i].splits.size(), levels[i - 1].splits.size());
  EXPECT_EQ(levels.back().splits.size(), 5u);
  for (const double tolerance : {0.0005, 0.001, 0.004, 0.2, 3.0, 20.0})
    EXPECT_EQ(levels[levelOf(levels, tolerance)].splits, naturalSplits(line, false, tolerance)) << tolerance;
}

TEST(NaturalSplits, ACircleHasNoneAndAnEllipseFour) {
  const auto ellipse = [](double a, double b) {
    return test::closedCurve(
        [=](double t) {
          const double angle = 2.0 * std::numbers::pi * (t + 0.1);
          return Vec2(a * std::cos(angle), b * std::sin(angle));
        },
        40);
  };
  EXPECT_TRUE(naturalSplits(ellipse(50.0, 50.0), true, 0.2).empty());
  EXPECT_EQ(naturalSplits(ellipse(50.0, 30.0), true, 0.2).size(), 4u);
}

TEST(SpanBetween, OfAClosedCurveRunsOverTheSeam) {
  const std::vector<double> splits = {0.2, 0.6};
  EXPECT_EQ(spanBetween(splits, 0.1, false), (ProfileSpan{0.0, 0.2}));
  EXPECT_EQ(spanBetween(splits, 0.3, false), (ProfileSpan{0.2, 0.6}));
  EXPECT_EQ(spanBetween(splits, 0.9, false), (ProfileSpan{0.6, 1.0}));
  EXPECT_EQ(spanBetween(splits, 0.9, true), (ProfileSpan{0.6, 1.2}));
  EXPECT_EQ(spanBetween(splits, 0.1, true), (ProfileSpan{0.6, 1.2}));
  EXPECT_EQ(spanBetween({0.5}, 0.1, true), (ProfileSpan{0.0, 1.0}));
}

TEST(NaturalTargets, NeedLessThanOnePolynomialForTheWholeCurve) {
  const NurbsCurve line = twoBumps(0.0);
  FairingParams params = toTarget(0, 0.2);
  const auto natural = fairAllTargets(line, false, params, {});
  params.targets.spans = TargetSpans::Whole;
  const auto whole = fairAllTargets(line, false, params, {});
  ASSERT_TRUE(natural && whole);
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_TRUE(natural->faired[i] && whole->faired[i]);
    EXPECT_LT(natural->faired[i]->report.neededMm.value(), 0.5 * whole->faired[i]->report.neededMm.value()) << i;
    EXPECT_LE(natural->faired[i]->report.extremaAfter, 3) << i;
    EXPECT_TRUE(natural->targets.profiles[i].isMonotone) << "between its splits";
  }
  const int best = natural->recommendedDegree.value_or(0);
  ASSERT_GE(best, 1);
  EXPECT_TRUE(natural->faired[best - 1]->report.withinTolerance);
  for (int lower = 1; lower < best; ++lower)
    EXPECT_FALSE(natural->faired[lower - 1]->report.withinTolerance) << "the lowest degree that is met";
  // What is recommended is what the automatic target takes.
  const auto chosen = fair(line, false, toTarget(0, 0.2), {});
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->curve, natural->faired[best - 1]->curve);
}

/// A sine, an arch with two bends and an arc of an ellipse, from 200 to 240 mm.
std::vector<NurbsCurve> bentLines() {
  const auto roof = [](double t) {
    const double x = 2.0 * t - 1.0;
    return Vec2(120.0 * x, 30.0 * (1.0 - x * x * x * x) + 4.0 * std::sin(3.0 * x));
  };
  const auto deepS = [](double f) { return 0.03 * std::sin(2.0 * std::numbers::pi * f) + 0.002 * bump(f, 0.3, 0.05); };
  return {test::wave(200.0, 15.0, 40), fromCurvature(deepS, 200.0, 60), test::fitted(roof, 40),
          test::ellipseQuarter(200.0, 120.0, 24)};
}
constexpr std::array kSeriesOfTest = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0};

/// By trying all spans, with the splits set by hand: the smallest tolerance of which the target is met over its spans,
/// or over those of a smaller one.
double neededByTrial(const NurbsCurve& line, int degree) {
  double needed = std::numeric_limits<double>::infinity();
  std::vector<double> before{-1.0};
  for (const double tolerance : kSeriesOfTest) {
    FairingParams params = toTarget(degree, 20.0);
    params.targets.splits = naturalSplits(line, false, tolerance);
    if (params.targets.splits == before) continue;
    before = params.targets.splits;
    if (params.targets.splits.empty()) params.targets.spans = TargetSpans::Whole;
    const auto faired = fair(line, false, params, {});
    if (!faired) return -1.0;
    needed = std::min(needed, std::max(tolerance > 0.001 ? tolerance : 0.0, faired->report.neededMm.value()));
  }
  return needed;
}

TEST(NaturalTargets, NeedTheSameWhateverTheTolerance) {
  std::size_t which = 0;
  for (const NurbsCurve& line : bentLines()) {
    SCOPED_TRACE(testing::Message() << "line " << which++);
    std::array<double, 6> needed{};
    std::array<int, 6> extrema{};
    extrema.fill(countedExtrema(line, false));
    for (int degree = 1; degree <= 6; ++degree) needed[degree - 1] = neededByTrial(line, degree);
    for (const double tolerance : {0.05, 0.13, 0.5, 0.9, 2.0, 7.0, 20.0}) {
      const auto targets = fairAllTargets(line, false, toTarget(1, tolerance), {});
      ASSERT_TRUE(targets);
      for (std::size_t i = 0; i < 6; ++i) {
        SCOPED_TRACE(testing::Message() << "target " << i + 1 << ", tolerance " << tolerance);
        ASSERT_TRUE(targets->faired[i]);
        const FairingReport& report = targets->faired[i]->report;
        const double now = report.neededMm.value();
        EXPECT_NEAR(now, needed[i], 1e-9);
        EXPECT_LE(report.extremaAfter, extrema[i]);
        extrema[i] = std::min(extrema[i], report.extremaAfter);
        if (now > tolerance) {
          EXPECT_FALSE(report.withinTolerance);
        } else if (now < (1.0 - 1e-9) * tolerance && !report.withinTolerance) {
          EXPECT_NE(report.note.find("curvature extrem"), std::string::npos) << report.note;
        }
        const auto chosen = fair(line, false, toTarget(static_cast<int>(i) + 1, tolerance), {});
        ASSERT_TRUE(chosen);
        EXPECT_EQ(chosen->curve, targets->faired[i]->curve);
        EXPECT_EQ(chosen->report.neededMm, report.neededMm);
        EXPECT_EQ(chosen->report.withinTolerance, report.withinTolerance);
      }
    }
  }
}

TEST(NaturalTargets, SimilarityIsThatOfTheCurvatureWhereTheLineBendsBothWays) {
  const NurbsCurve line = fromCurvature([](double f) { return 0.02 * std::cos(std::numbers::pi * f); }, 100.0, 60);
  const TargetSet set = fitTargets(line, {}, false);
  EXPECT_TRUE(set.comparesCurvature);
  EXPECT_GT(set.profiles[2].similarity, 0.999) << "a cubic is all but this profile";
  EXPECT_FALSE(fitTargets(twoBumps(0.0), {}, false).comparesCurvature);
}

TEST(FairSpans, MoveOnlyTheSpanAndAddNoExtremum) {
  const NurbsCurve line = twoBumps(0.0);
  FairingParams params = toTarget(0, 0.3);
  const auto splits = naturalSplits(line, false, params.toleranceMm);
  const ArcLength before(line);
  int moved = 0;
  for (const double at : {0.1, 0.4, 0.6, 0.9}) {
    params.spanTargets = {{at, 3}};
    const auto faired = fair(line, false, params, {});
    ASSERT_TRUE(faired) << faired.error().message;
    const ProfileSpan span = spanBetween(splits, at, false);
    moved += faired->report.maxDeviationMm > 1e-3 ? 1 : 0;
    EXPECT_LE(faired->report.maxDeviationMm, params.toleranceMm);
    EXPECT_LE(countedExtrema(faired->curve, false), countedExtrema(line, false)) << at;
    // The rest to the last digit but rounding, with three derivatives at least where it meets the span.
    for (int i = 0; i <= 100; ++i) {
      const double f = i / 100.0, u = before.parameter(f * before.total());
      if (f > span.from && f < span.to) continue;
      const auto a = line.derivatives(u, 3), b = faired->curve.derivatives(u, 3);
      for (std::size_t k = 0; k < 4; ++k) EXPECT_LT((a[k] - b[k]).norm(), 1e-7 * (1.0 + a[k].norm())) << f << " " << k;
    }
    EXPECT_LE(deviation(faired->curve, line).max, params.toleranceMm);
  }
  EXPECT_GE(moved, 2) << "where the target would add an extremum, the span stays";
}

TEST(FairSpans, GiveTogetherWhatTheyGiveAlone) {
  const NurbsCurve line = twoBumps(0.0);
  FairingParams params = toTarget(0, 0.3);
  params.spanTargets = {{0.1, 2}};
  const auto first = fair(line, false, params, {});
  params.spanTargets = {{0.6, 3}};
  const auto second = fair(line, false, params, {});
  params.spanTargets = {{0.1, 2}, {0.6, 3}};
  const auto both = fair(line, false, params, {});
  ASSERT_TRUE(first && second && both);
  EXPECT_EQ(both->report.maxDeviationMm, std::max(first->report.maxDeviationMm, second->report.maxDeviationMm));
  // Of two targets for one span the later one counts.
  params.spanTargets = {{0.05, 5}, {0.1, 2}};
  const auto later = fair(line, false, params, {});
  ASSERT_TRUE(later);
  EXPECT_EQ(later->curve, first->curve);
}

TEST(FairSpans, TheTileShowsWhatChoosingItGives) {
  const NurbsCurve line = twoBumps(0.0);
  const TargetsJob job{line, false, toTarget(0, 0.3), 0.4};
  const auto tiles = std::move(fairAllTargets(std::span(&job, 1), {}).front());
  ASSERT_TRUE(tiles && tiles->span);
  FairingParams params = job.params;
  params.spanTargets = {{0.4, 3}};
  const auto chosen = fair(line, false, params, {});
  ASSERT_TRUE(chosen && tiles->faired[2]);
  EXPECT_EQ(chosen->curve, tiles->faired[2]->curve);
  EXPECT_EQ(chosen->report.neededMm, tiles->faired[2]->report.neededMm);
  // Outside of the span the profile is the curve's own curvature.
  const TargetProfile& profile = tiles->targets.profiles[2];
  for (const auto& [f, kappa] : tiles->targets.samples) {
    if (f >= tiles->span->from && f <= tiles->span->to) continue;
    EXPECT_NEAR(profile.curvatureAt(f), kappa, 1e-4) << f;
  }
}

TEST(FairSpans, OfAClosedCurveMayLieOverTheSeam) {
  const NurbsCurve egg = test::closedCurve(
      [](double t) {
        const double angle = 2.0 * std::numbers::pi * (t + 0.05);
        return Vec2(50.0 * std::cos(angle), 30.0 * std::sin(angle) + 4.0 * std::cos(2.0 * angle));
      },
      40);
  FairingParams params = toTarget(0, 0.5);
  const auto splits = naturalSplits(egg, true, params.toleranceMm);
  ASSERT_GE(splits.size(), 4u);
  const ProfileSpan span = spanBetween(splits, 0.5 * splits.front(), true);
  ASSERT_GT(span.to, 1.0);
  params.spanTargets = {{0.5 * splits.front(), 1}};
  const auto faired = fair(egg, true, params, {});
  ASSERT_TRUE(faired) << faired.error().message;
  EXPECT_LE(countedExtrema(faired->curve, true), countedExtrema(egg, true));
  EXPECT_LE(deviation(faired->curve, egg).max, 0.5);
  const auto start = faired->curve.derivatives(faired->curve.start(), 2),
             end = faired->curve.derivatives(faired->curve.end(), 2);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT((start[k] - end[k]).norm(), 1e-6 * (1.0 + start[k].norm()));
  const ArcLength arc(egg);
  const double middle = 0.5 * (span.from + span.to - 1.0);
  for (const double f : {splits[1] + 0.01, 0.5, splits.back() - 0.01}) {
    const double u = arc.parameter(f * arc.total());
    EXPECT_LT((faired->curve.point(u) - egg.point(u)).norm(), 1e-9) << f << " " << middle;
  }
}

TEST(ClosedFairing, TheDeviationIsThatFromTheCurveTheUserHad) {
  // Closed, but its ends meet with a jump of the curvature: to be moved it must be made periodic first.
  const NurbsCurve open = test::fitted(
      [](double t) {
        const double angle = 2.0 * std::numbers::pi * t;
        return Vec2((50.0 + 3.0 * t * (1.0 - t)) * std::cos(angle), 30.0 * std::sin(angle) + 2.0 * std::sin(3 * angle));
      },
      24);
  std::vector<Vec2> points(open.controlPoints().begin(), open.controlPoints().end());
  points[2] += Vec2(0.0, 0.4);
  points.back() = points.front();
  const NurbsCurve curve = NurbsCurve::make(5, {open.knots().begin(), open.knots().end()}, points).value();
  for (const double tolerance : {0.002, 0.05, 0.5}) {
    for (const FairingMode mode :
         {FairingMode::Tolerance, FairingMode::Monotone, FairingMode::Target, FairingMode::LowPass}) {
      FairingParams params = toTarget(0, tolerance);
      params.mode = mode;
      const auto faired = fair(curve, true, params, {});
      ASSERT_TRUE(faired) << faired.error().message;
      const double real = std::max(deviation(faired->curve, curve).max, deviation(curve, faired->curve).max);
      EXPECT_LE(real, tolerance * (1.0 + 1e-6)) << tolerance << " " << static_cast<int>(mode);
      EXPECT_NEAR(faired->report.maxDeviationMm, real, 0.02 * real + 1e-9)
          << tolerance << " " << static_cast<int>(mode);
      EXPECT_LE(countedExtrema(faired->curve, true), countedExtrema(curve, true));
    }
  }
}

}  // namespace
}  // namespace batten
