// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/edge_length_fairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/construct/construct.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/curvature_jump.h"
#include "core/fairing/fairing.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/curve_targets.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/method_truths.h"

namespace batten {
namespace {

/// The Bezier path of a noisy line of known curvature, 0.001 to 0.008 evenly.
NurbsCurve clothoidPath(unsigned seed) {
  for (const test::OpenTruth& truth : test::openTruths()) {
    if (truth.name != "clothoid") continue;
    PieceSet set;
    Piece& piece = set.pieces.emplace_back();
    piece.points = piecePoints(test::noisyPoints(truth, 0.1, seed));
    for (std::size_t i = 1; i < piece.points.size(); ++i)
      piece.lengthPx += (piece.points[i].at - piece.points[i - 1].at).norm();
    ConstructContour contour;
    ConstructPiece& made = contour.pieces.emplace_back();
    made.points = piece.points;
    made.stations = regressionSegments(set, {}, {})->pieces[0].stations;
    ConstructParams params;
    params.method = ConstructMethod::Bezier;
    params.lowPass = 0.0;
    return construct(contour, params, {})->front().curve;
  }
  return {};
}

FairingParams edges(double tolerance) {
  FairingParams params;
  params.mode = FairingMode::Target;
  params.means = FairingMeans::EdgeLengths;
  params.toleranceMm = tolerance;
  return params;
}

double misfit(const NurbsCurve& curve, double from, double to) {
  double sum = 0.0;
  const auto samples = sampleByArcLength(curve, 501);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += std::pow(samples[i].kappa - (from + (to - from) * static_cast<double>(i) / 500.0), 2) / 501.0;
  }
  return std::sqrt(sum);
}

TEST(EdgeLengthFairing, FollowsADrawnCurvatureWithOneCurvatureAtEveryJoint) {
  const NurbsCurve path = clothoidPath(1);
  FairingParams params = edges(20.0);
  params.target = FairingTarget::Drawn;
  params.profile = {{0.0, 0.001}, {1.0, 0.008}};
  const auto faired = fairByEdgeLengths(path, false, params, {});
  ASSERT_TRUE(faired) << faired.error().message;
  EXPECT_LT(misfit(faired->curve, 0.001, 0.008), 0.5 * misfit(path, 0.001, 0.008));
  EXPECT_LT(faired->report.objectiveAfter, 0.5 * faired->report.objectiveBefore);
  EXPECT_LE(largestCurvatureJump(faired->curve, false), 1e-9);
  EXPECT_LE(faired->report.maxDeviationMm, 20.0);
  EXPECT_GT(faired->report.maxDeviationMm, 0.0);
  EXPECT_LT((faired->curve.point(faired->curve.end()) - path.point(path.end())).norm(), 1e-9 * extent(path));
  EXPECT_LT((faired->curve.point(faired->curve.start()) - path.point(path.start())).norm(), 1e-9 * extent(path));
}

TEST(EdgeLengthFairing, NeverLeavesTheTolerance) {
  const NurbsCurve path = clothoidPath(2);
  for (const double tolerance : {0.01, 0.1, 1.0}) {
    for (const FairingMode mode : {FairingMode::Target, FairingMode::LowPass}) {
      FairingParams params = edges(tolerance);
      params.mode = mode;
      params.target = FairingTarget::Degree1;
      params.lowPassMm = 200.0;
      const auto faired = fairByEdgeLengths(path, false, params, {});
      ASSERT_TRUE(faired);
      EXPECT_LE(deviation(faired->curve, path).max, tolerance);
      EXPECT_LE(faired->report.maxDeviationMm, tolerance);
      EXPECT_LE(faired->report.objectiveAfter, faired->report.objectiveBefore);
    }
  }
}

TEST(EdgeLengthFairing, KeepsHeldTangents) {
  const NurbsCurve path = clothoidPath(3);
  FairingParams params = edges(5.0);
  params.target = FairingTarget::Degree1;
  params.startHold.tangent = params.endHold.tangent = true;
  const auto faired = fairByEdgeLengths(path, false, params, {});
  ASSERT_TRUE(faired);
  const auto before = sampleByArcLength(path, 2), after = sampleByArcLength(faired->curve, 2);
  for (const std::size_t i : {0u, 1u}) EXPECT_LT((before[i].tangent - after[i].tangent).norm(), 1e-9);
}

TEST(EdgeLengthFairing, MovesControlPointsOfOtherCurvesAndSaysSo) {
  const auto spline = NurbsCurve::make(5, {0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3},
                                       {{0, 0}, {10, 3}, {20, 5}, {30, 6}, {40, 5}, {50, 3}, {60, 1}, {70, -5}});
  ASSERT_TRUE(spline);
  FairingParams params = edges(1.0);
  params.target = FairingTarget::Degree2;
  const auto faired = fairByEdgeLengths(*spline, false, params, {});
  ASSERT_TRUE(faired);
  EXPECT_FALSE(faired->report.note.empty());
}

TEST(EdgeLengthFairing, IsReachedByTheParameter) {
  Recipe recipe;
  ASSERT_TRUE(setParameter(recipe, "fairing.moves", "edges"));
  EXPECT_FALSE(movesEdgeLengths(recipe.fairing));
  ASSERT_TRUE(setParameter(recipe, "fairing.mode", "target"));
  EXPECT_TRUE(movesEdgeLengths(recipe.fairing));
}

/// The six tiles show what a click on them gives, whatever was chosen before.
TEST(EdgeLengthFairing, IsWhatTheTargetsShow) {
  TracedCurve curve;
  curve.sketched = clothoidPath(2);
  curve.fairingUsed = edges(0.5);
  curve.fairingUsed.mode = FairingMode::None;
  const auto outcomes = targetsFor(curve, {});
  ASSERT_TRUE(outcomes) << outcomes.error().message;
  for (int degree = 1; degree <= 6; ++degree) {
    const int at = degree - 1;
    if (!outcomes->targets.profiles[at].valid) continue;
    FairingParams params = edges(0.5);
    params.target = targetOfDegree(degree);
    const auto chosen = fairByEdgeLengths(curve.sketched, false, params, {});
    ASSERT_TRUE(chosen && outcomes->faired[at]);
    EXPECT_EQ(outcomes->faired[at]->report.maxDeviationMm, chosen->report.maxDeviationMm);
    EXPECT_LT(deviation(outcomes->faired[at]->curve, chosen->curve).max, 1e-9);
  }
  const std::vector<TracedCurve> all = {curve};
  const auto alike = targetsForAll(all, {});
  ASSERT_TRUE(alike[0]);
  EXPECT_EQ(alike[0]->faired[2]->report.maxDeviationMm, outcomes->faired[2]->report.maxDeviationMm);
}

TEST(EdgeLengthFairing, TargetsOfACurveThatIsNoPathAreThoseOfItsControlPoints) {
  TracedCurve curve;
  const auto spline = NurbsCurve::make(5, {0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3},
                                       {{0, 0}, {10, 3}, {20, 5}, {30, 6}, {40, 5}, {50, 3}, {60, 1}, {70, -5}});
  ASSERT_TRUE(spline);
  curve.sketched = *spline;
  curve.fairingUsed = edges(1.0);
  const auto moved = targetsFor(curve, {});
  const auto points = fairAllTargets(curve.sketched, false, curve.fairingUsed, {});
  ASSERT_TRUE(moved && points);
  EXPECT_EQ(moved->recommendedDegree, points->recommendedDegree);
  for (std::size_t i = 0; i < points->faired.size(); ++i) {
    ASSERT_EQ(moved->faired[i].has_value(), points->faired[i].has_value());
    EXPECT_EQ(moved->problems[i], points->problems[i]);
    if (!moved->faired[i]) continue;
    EXPECT_EQ(moved->faired[i]->curve, points->faired[i]->curve);
    EXPECT_FALSE(moved->faired[i]->report.note.empty());
  }
}

/// Cancelled at any moment, the targets are either all there or none is.
TEST(EdgeLengthFairing, CancelledTargetsAreNone) {
  std::vector<TracedCurve> curves(2);
  for (TracedCurve& curve : curves) {
    curve.sketched = clothoidPath(2);
    curve.fairingUsed = edges(0.5);
  }
  const auto whole = targetsForAll(curves, {});
  for (const int reports : {1, 3, 7}) {
    RunContext context;
    context.threads = 1;
    auto left = std::make_shared<int>(reports);
    std::vector<double> progress;
    context.progress = [&, token = context.cancel](double share) mutable {
      progress.push_back(share);
      if (--*left == 0) token.cancel();
    };
    for (const auto& outcomes : targetsForAll(curves, context)) {
      ASSERT_FALSE(outcomes);
      EXPECT_EQ(outcomes.error().code, ErrorCode::Cancelled);
    }
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end())) << "one way for all curves";
  }
  for (const auto& outcomes : whole) {
    ASSERT_TRUE(outcomes);
    for (const auto& faired : outcomes->faired) EXPECT_TRUE(faired.has_value());
  }
}

}  // namespace
}  // namespace batten
