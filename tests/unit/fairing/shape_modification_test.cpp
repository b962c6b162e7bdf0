// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing.h"
#include "core/fairing/model/curvature_rows.h"
#include "core/fairing/model/fairing_model.h"
#include "core/fairing/model/minimise.h"
#include "core/fairing/model/sketch_deviation.h"
#include "core/fairing/model/target_steps.h"
#include "core/fairing/target/shape_modification.h"
#include "tests/support/known_answers.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

NurbsCurve uniformQuintic(const std::vector<Vec2>& points) {
  std::vector<double> knots;
  for (int i = 0; i < static_cast<int>(points.size()) + 6; ++i) knots.push_back(i - 5);
  return NurbsCurve::make(5, knots, points).value();
}

TEST(CurvatureRow, MatchesTheKnownJacobian) {
  const auto data = test::knownAnswer(BATTEN_TEST_DATA, "03_curvature.json");
  const NurbsCurve curve = uniformQuintic(test::toPoints(data.at("control_points")));
  const SpanBasis basis(5, curve.knots(), curve.controlPointCount(), 0);
  const SpanCurve fast(basis, curve.controlPoints());
  for (std::size_t k = 0; k < data.at("jacobian_t").size(); ++k) {
    const double t = data.at("jacobian_t")[k];
    const int span = std::min(static_cast<int>(t), basis.spanCount() - 1);
    const SpanPlace place{span, t - span};
    const LocalRow row = curvatureRow(fast.at(place, 4), basis.row(place, 3), 5);
    const auto known = test::toPoints(data.at("jacobian_fixed_t_dk_dq")[k]);
    for (int j = 0; j <= 5; ++j) {
      const Vec2& wanted = known[basis.point(span, j)];
      EXPECT_LT((row[j] - wanted).norm(), 1e-12);
    }
  }
}

TEST(SpanCurve, AgreesWithTheGeneralEvaluationAndTheKnownArcLength) {
  const auto data = test::knownAnswer(BATTEN_TEST_DATA, "03_curvature.json");
  const NurbsCurve curve = uniformQuintic(test::toPoints(data.at("control_points")));
  const SpanBasis basis(5, curve.knots(), curve.controlPointCount(), 0);
  const SpanCurve fast(basis, curve.controlPoints());
  for (double t = 0.05; t < 7.0; t += 0.3) {
    const SpanPlace place{static_cast<int>(t), t - std::floor(t)};
    const Jet jet = fast.at(place, 4);
    const auto wanted = curve.derivatives(t, 4);
    for (std::size_t d = 0; d <= 4; ++d) EXPECT_LT((jet[d] - wanted[d]).norm(), 1e-9 * (1.0 + wanted[d].norm()));
  }
  const auto arc = equalArcPlaces(fast, 11, false);
  ASSERT_TRUE(arc);
  EXPECT_NEAR(arc->length, data.at("length").get<double>(), 1e-5);
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_NEAR(basis.parameter(arc->places[i]), data.at("t_at_arc_fraction")[i].get<double>(), 1e-6);
  }
}

/// Finite differences of the residuals with samples re-located at equal arc length, against J v and y'J.
void checkModel(const NurbsCurve& curve, bool closed, bool profile) {
  FairingParams params;
  const auto setup = makeSetup(curve, closed, params);
  ASSERT_TRUE(setup) << setup.error().message;
  FairingObjective objective;
  objective.reference = 0.01;
  if (profile) {
    for (int i = 0; i < (*setup)->sampleCount(); ++i)
      objective.wanted.push_back(0.008 + 0.004 * std::sin(6.3 * (*setup)->fraction(i)));
  }
  const auto state = evaluate(**setup, objective, {}, (*setup)->points, (*setup)->start.places);
  ASSERT_TRUE(state);
  const FairingModel model(**setup, objective, {}, *state);
  const int count = (*setup)->unknowns.count();
  Eigen::VectorXd v(count), y(state->residual.size());
  for (int i = 0; i < count; ++i) v[i] = std::sin(0.7 * i + 0.3);
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = std::cos(0.37 * static_cast<double>(i));
  const double h = 1e-5 * (*setup)->extent / 100.0;
  std::vector<Vec2> plus = (*setup)->points, minus = plus;
  (*setup)->unknowns.move(h * v, plus);
  (*setup)->unknowns.move(-h * v, minus);
  const auto a = evaluate(**setup, objective, {}, plus, (*setup)->start.places);
  const auto b = evaluate(**setup, objective, {}, minus, (*setup)->start.places);
  ASSERT_TRUE(a && b);
  const Eigen::VectorXd difference = (a->residual - b->residual) / (2.0 * h), jv = model.apply(v);
  EXPECT_LT((difference - jv).norm(), 1e-3 * difference.norm());
  EXPECT_NEAR(y.dot(jv), v.dot(model.applyTransposed(y)), 1e-10 * y.norm() * jv.norm());
}

TEST(FairingModel, MatchesFiniteDifferencesWithRelocatedSamples) {
  checkModel(test::noisy(test::ellipseQuarter(200, 120, 16), 0.5, 3), false, true);
  checkModel(test::noisy(test::ellipseQuarter(200, 120, 16), 0.1, 3), false, false);
  const auto oval = [](double f) {
    const double a = 2.0 * std::numbers::pi * f;
    return Vec2(100.0 * std::cos(a) + 3.0 * std::cos(3.0 * a), 60.0 * std::sin(a));
  };
  checkModel(test::closedCurve(oval, 24), true, true);
  checkModel(test::closedCurve(oval, 24), true, false);
}

TEST(ModifyShape, FindsTheKnownCurves) {
  const auto data = test::knownAnswer(BATTEN_TEST_DATA, "11_fairing.json");
  const NurbsCurve start = uniformQuintic(test::toPoints(data.at("start_control_points")));
  TargetProfile profile;
  profile.degree = 3;
  profile.valid = true;
  profile.coefficients = data.at("target_coef").get<std::vector<double>>();
  FairingParams params;
  params.targets.samples = 101;
  const auto setup = makeSetup(start, false, params);
  ASSERT_TRUE(setup);
  FairingObjective objective;
  double sum = 0.0;
  for (int i = 0; i < 101; ++i) {
    objective.wanted.push_back(profile.curvatureAt(i / 100.0));
    sum += std::pow(objective.wanted.back(), 2);
  }
  objective.reference = std::sqrt(sum / 101);
  for (const auto& known : data.at("results")) {
    SCOPED_TRACE(known.at("wpos").get<double>());
    const FairingCorridor corridor{.weight = known.at("wpos").get<double>()};
    auto state = evaluate(**setup, objective, corridor, (*setup)->points, (*setup)->start.places);
    ASSERT_TRUE(state);
    const double startMisfit = std::sqrt(state->misfit);
    EXPECT_NEAR(startMisfit, data.at("start_krel").get<double>(), 1e-6);
    const FairingRun run = minimise(**setup, objective, corridor, std::move(*state), {60, 1e-9}, {});
    EXPECT_NEAR(std::sqrt(run.state.misfit), known.at("krel").get<double>(), 2e-3);
    const auto faired = toCurve(**setup, run.state.points);
    const auto wanted = test::toPoints(known.at("curve_at_0_25_50_75_100pct_arclength"));
    const auto arc = equalArcPlaces(run.state.curve, 5, false);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_LT((run.state.curve.at(arc->places[i], 0)[0] - wanted[i]).norm(),
                data.at("tolerance_points").get<double>())
          << i;
    }
    EXPECT_LT((faired->point(0) - start.point(0)).norm(), 1e-9 * extent(start));
    EXPECT_LT((faired->point(7) - start.point(7)).norm(), 1e-9 * extent(start));
    EXPECT_NEAR(largestDeviation(**setup, run.state.points), known.at("max_deviation").get<double>(), 0.02);
  }
}

TEST(ModifyShape, NeverLeavesTheToleranceAndSaysWhy) {
  const NurbsCurve start = test::noisy(test::ellipseQuarter(200, 120, 20), 0.5, 7);
  double before = 1e9;
  int extrema = countedExtrema(start, false);
  for (const double tolerance : {0.01, 0.05, 0.2, 1.0, 5.0}) {
    FairingParams params;
    params.mode = FairingMode::Target;
    params.target = FairingTarget::Degree3;
    params.targets.spans = TargetSpans::Whole;
    params.toleranceMm = tolerance;
    const auto faired = fair(start, false, params, {});
    ASSERT_TRUE(faired) << faired.error().message;
    EXPECT_LE(deviation(faired->curve, start).max, tolerance);
    EXPECT_LE(deviation(start, faired->curve).max, tolerance);
    EXPECT_EQ(faired->report.withinTolerance, faired->report.neededMm.value() <= tolerance);
    EXPECT_EQ(faired->report.why == Termination::ToleranceLimited, !faired->report.withinTolerance);
    // Farther from the profile only for fewer extrema.
    EXPECT_TRUE(faired->report.objectiveAfter <= before * 1.001 || faired->report.extremaAfter < extrema)
        << tolerance << ": " << faired->report.objectiveAfter << " after " << before << ", " << extrema;
    EXPECT_LE(faired->report.extremaAfter, extrema);
    extrema = faired->report.extremaAfter;
    if (!faired->report.withinTolerance) {
      EXPECT_FALSE(faired->report.note.empty());
    }
    EXPECT_LE(faired->report.extremaAfter, faired->report.extremaBefore);
    before = faired->report.objectiveAfter;
  }
}

TEST(ModifyShape, HoldsTangentAndCurvatureOfTheEnds) {
  const NurbsCurve start = test::noisy(test::ellipseQuarter(200, 120, 20), 0.3, 5);
  FairingParams params;
  params.mode = FairingMode::Target;
  params.target = FairingTarget::Degree2;
  params.toleranceMm = 2.0;
  params.startHold.tangent = true;
  params.endHold.curvature = true;
  const auto faired = fair(start, false, params, {});
  ASSERT_TRUE(faired);
  const auto a = start.derivatives(0.0, 1)[1].normalized(), b = faired->curve.derivatives(0.0, 1)[1].normalized();
  EXPECT_NEAR(cross(a, b), 0.0, 1e-10);
  EXPECT_NEAR(*curvature(start, 1.0), *curvature(faired->curve, 1.0), 1e-10);
  EXPECT_GT(faired->report.maxDeviationMm, 0.05);
}

/// The tolerance allows the whole target, but the curves on the way to it turn back more often.
TEST(ModifyShape, ATargetThatIsHardlyFollowedIsNotMet) {
  int met = 0, hardly = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const NurbsCurve start = test::noisy(test::ellipseQuarter(200, 120, 14), 0.02, seed);
    for (const int degree : {1, 3}) {
      FairingParams params;
      params.mode = FairingMode::Target;
      params.target = targetOfDegree(degree);
      params.toleranceMm = 20.0;
      params.targets.spans = TargetSpans::Whole;
      params.startHold.curvature = params.endHold.curvature = true;
      const auto faired = fair(start, false, params, {});
      ASSERT_TRUE(faired) << faired.error().message;
      const auto setup = makeSetup(start, false, params);
      ASSERT_TRUE(setup);
      const auto objective =
          targetObjective(**setup, fitTargets(start, params.targets, false).profiles[std::size_t(degree) - 1]);
      ASSERT_TRUE(objective);
      const TargetSteps followed(**setup, *objective, {});
      ASSERT_FALSE(followed.steps().empty());
      const FairingReport& report = faired->report;
      const double full = std::sqrt(followed.steps().front().misfit);
      const double left = (report.objectiveAfter - full) / (report.objectiveBefore - full);
      SCOPED_TRACE(testing::Message() << "curve " << seed << ", degree " << degree << ", left " << left);
      if (left > 0.2) {
        ++hardly;
        EXPECT_FALSE(report.withinTolerance);
        EXPECT_FALSE(report.note.empty());
      } else if (left < 0.05) {
        ++met;
        EXPECT_TRUE(report.withinTolerance) << report.note;
      }
    }
  }
  EXPECT_GT(hardly, 0);
  EXPECT_GT(met, 0);
}

TEST(TargetSteps, ReachedLaterAreThoseFollowedAtOnce) {
  const NurbsCurve curve = test::noisy(test::wave(300.0, 20.0, 24), 0.5, 3);
  const auto setup = makeSetup(curve, false, {});
  ASSERT_TRUE(setup);
  const auto objective = targetObjective(**setup, fitTargets(curve, {}).profiles[0]);
  ASSERT_TRUE(objective);
  const RunContext context;
  const TargetSteps whole(**setup, *objective, context);
  ASSERT_GT(whole.steps().size(), 3u);
  const double bound = 1.001 * whole.steps()[2].deviationMm();  // left by the step after it
  ASSERT_GT(whole.steps()[1].deviationMm(), bound);
  const auto isSame = [](std::span<const TargetStep> a, std::span<const TargetStep> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const TargetStep& x, const TargetStep& y) { return x.points == y.points; });
  };
  TargetSteps steps(**setup, *objective, context, bound);
  EXPECT_TRUE(steps.endsEarly());
  EXPECT_TRUE(isSame(steps.steps(), whole.steps().subspan(1)));
  const int made = steps.iterations();
  steps.reach(std::numeric_limits<double>::infinity());
  EXPECT_FALSE(steps.endsEarly());
  EXPECT_TRUE(isSame(steps.steps(), whole.steps()));
  EXPECT_GT(steps.iterations(), made);
  EXPECT_EQ(steps.iterations(), whole.iterations());
  steps.reach(bound);
  EXPECT_TRUE(steps.endsEarly());
  EXPECT_TRUE(isSame(steps.steps(), whole.steps().subspan(1)));
  EXPECT_EQ(steps.iterations(), whole.iterations());
}

/// Against a minimisation that goes on from the end for as long as it likes.
TEST(TargetSteps, ComeToRestAtTheTarget) {
  const RunContext context;
  for (const int degree : {2, 3, 5}) {
    const NurbsCurve curve = test::noisy(test::ellipseQuarter(120.0, 60.0, 24), 0.05, 7);
    const auto setup = makeSetup(curve, false, {});
    ASSERT_TRUE(setup);
    const auto objective = targetObjective(**setup, fitTargets(curve, {}).profiles[degree - 1]);
    ASSERT_TRUE(objective);
    const TargetSteps followed(**setup, *objective, context);
    ASSERT_FALSE(followed.steps().empty());
    const TargetStep& end = followed.steps().front();
    auto state = evaluate(**setup, *objective, {.weight = end.weight}, end.points, end.feet);
    ASSERT_TRUE(state);
    const FairingRun longer = minimise(**setup, *objective, {.weight = end.weight}, std::move(*state),
                                       {.iterations = 1000, .relativeDecrease = 1e-9, .slideFloor = 1e-3}, context);
    EXPECT_LT(std::sqrt(end.misfit), 1.05 * std::sqrt(longer.state.misfit)) << degree;
    EXPECT_NEAR(end.deviationMm() / largestDeviation(**setup, longer.state.points, true), 1.0, 0.02) << degree;
  }
}

TEST(TargetSteps, KeepTheStepsThatAreAskedForTwice) {
  const NurbsCurve curve = test::noisy(test::wave(200.0, 20.0, 16), 0.05, 3);
  const auto setup = makeSetup(curve, false, {});
  ASSERT_TRUE(setup);
  const auto objective = targetObjective(**setup, fitTargets(curve, {}).profiles[2]);
  ASSERT_TRUE(objective);
  const RunContext context;
  const TargetSteps followed(**setup, *objective, context);
  ASSERT_GE(followed.steps().size(), 2u);
  const TargetStep &near = followed.steps()[1], &far = followed.steps()[0];
  const double weight = std::sqrt(near.weight * far.weight);
  const TargetStep* made = followed.between(near, weight);
  ASSERT_NE(made, nullptr);
  const int iterations = followed.iterations();
  EXPECT_EQ(followed.between(near, weight), made);
  EXPECT_EQ(followed.iterations(), iterations);
  const TargetStep* other = followed.between(far, weight);
  EXPECT_NE(other, made) << "from another step";
  EXPECT_GT(followed.iterations(), iterations);
  EXPECT_EQ(followed.between(near, weight), made) << "after others were made";
}

TEST(ModifyShape, ClosedCurvesStillMeetWithAllDerivatives) {
  const auto bumpy = [](double f) {
    const double a = 2.0 * std::numbers::pi * f, r = 1.0 + 0.004 * std::sin(11.0 * a);
    return Vec2(100.0 * r * std::cos(a), 70.0 * r * std::sin(a));
  };
  const NurbsCurve start = test::closedCurve(bumpy, 40);
  for (const FairingMode mode : {FairingMode::Target, FairingMode::Tolerance}) {
    FairingParams params;
    params.mode = mode;
    params.targets.spans = TargetSpans::Whole;
    params.toleranceMm = 0.5;
    const auto faired = fair(start, true, params, {});
    ASSERT_TRUE(faired) << faired.error().message;
    EXPECT_EQ(faired->curve.knots().size(), start.knots().size());
    EXPECT_GT(faired->report.maxDeviationMm, 0.05);
    EXPECT_LE(deviation(faired->curve, start).max, 0.5);
    const auto a = faired->curve.derivatives(0.0, 4), b = faired->curve.derivatives(1.0, 4);
    double scale = extent(start);
    for (std::size_t d = 0; d <= 4; ++d) {
      EXPECT_LT((a[d] - b[d]).norm(), 1e-9 * scale) << "derivative " << d;
      scale *= 40;
    }
  }
}

TEST(ModifyShape, StopsWhenCancelled) {
  RunContext context;
  context.cancel.cancel();
  const NurbsCurve start = test::noisy(test::ellipseQuarter(200, 120, 20), 0.5, 7);
  for (const FairingMode mode : {FairingMode::Target, FairingMode::Tolerance}) {
    FairingParams params;
    params.mode = mode;
    const auto faired = fair(start, false, params, context);
    ASSERT_FALSE(faired);
    EXPECT_EQ(faired.error().code, ErrorCode::Cancelled);
  }
  EXPECT_FALSE(fairAllTargets(start, false, {}, context));
}

}  // namespace
}  // namespace batten
