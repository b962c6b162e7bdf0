// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/curve_targets.h"
#include "core/pipeline/run/left_as_drawn.h"
#include "core/pipeline/run/piece_choices.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/unit/pipeline/ellipse_scan.h"

namespace batten {
namespace {

PipelineOutput traced(bool light, FairingMode mode, double toleranceMm = 0.2) {
  Recipe recipe;
  recipe.construct.light = light;
  recipe.fairing.mode = mode;
  recipe.fairing.toleranceMm = toleranceMm;
  StageCache cache;
  return runPipeline(test::ellipseScan(), recipe, cache, {}, {});
}

/// Largest distance of many places of one curve from the other.
double apart(const NurbsCurve& a, const NurbsCurve& b) {
  double worst = 0.0;
  for (int i = 0; i <= 400; ++i) {
    worst = std::max(worst, closestPoint(b, a.point(a.start() + (a.end() - a.start()) * i / 400.0)).distance);
  }
  return worst;
}

double apartBothWays(const NurbsCurve& a, const NurbsCurve& b) { return std::max(apart(a, b), apart(b, a)); }

constexpr std::array kFairingModes = {FairingMode::Tolerance, FairingMode::Target, FairingMode::Monotone,
                                      FairingMode::LowPass};

TEST(LightCurves, StandForTheDenseOneThatFairingStartsFrom) {
  const auto dense = traced(false, FairingMode::None), light = traced(true, FairingMode::None);
  ASSERT_FALSE(dense.error || light.error);
  const TracedCurve &before = dense.faired->curves.front(), &after = light.faired->curves.front();
  EXPECT_FALSE(before.construct.light);
  EXPECT_FALSE(before.dense);
  EXPECT_EQ(before.fairingStart(), before.sketched);
  ASSERT_TRUE(after.construct.light);
  EXPECT_TRUE(after.construct.light->found);
  EXPECT_EQ(after.dense, before.sketched) << "the fit itself is the same";
  EXPECT_EQ(after.fairingStart(), before.sketched);
  EXPECT_EQ(after.faired, after.sketched);
  EXPECT_LT(after.construct.light->points, before.sketched.controlPointCount() / 2);
  EXPECT_LE(after.sketchedFigures.extrema, before.sketchedFigures.extrema);
  const double tolerance = ConstructParams{}.lightTolerancePx * light.frame.mmPerPx;
  EXPECT_LE(apart(after.sketched, before.sketched), 1.02 * tolerance);
  EXPECT_LE(apart(before.sketched, after.sketched), 1.02 * tolerance);
}

TEST(LightCurves, TakeNoPartOfSparingControlPoints) {
  Recipe recipe;
  StageCache cache;
  const auto usual = runPipeline(test::ellipseScan(), recipe, cache, {}, {});
  recipe.construct.knotRemovalTolerance = 0.0;
  const auto other = runPipeline(test::ellipseScan(), recipe, cache, {}, {});
  ASSERT_FALSE(usual.error || other.error);
  EXPECT_EQ(usual.faired->curves.front().dense, other.faired->curves.front().dense);
  EXPECT_EQ(usual.faired->curves.front().sketched, other.faired->curves.front().sketched);
}

TEST(LightCurves, KeepTheToleranceOfTheFairing) {
  for (const FairingMode mode : {FairingMode::Tolerance, FairingMode::Target, FairingMode::Monotone}) {
    const double toleranceMm = 0.15;
    const auto out = traced(true, mode, toleranceMm);
    ASSERT_FALSE(out.error);
    const TracedCurve& curve = out.faired->curves.front();
    EXPECT_LE(apartBothWays(curve.faired, curve.sketched), 1.001 * toleranceMm);
    EXPECT_NEAR(apartBothWays(curve.faired, curve.sketched), curve.fairing.maxDeviationMm, 0.02 * toleranceMm);
    const auto dense = traced(false, mode, toleranceMm);
    EXPECT_LE(curve.fairedFigures.extrema, dense.faired->curves.front().fairedFigures.extrema);
    // One more for the seam, which lies where the dense curve begins.
    EXPECT_LE(curve.faired.controlPointCount(), dense.faired->curves.front().faired.controlPointCount() + 1);
  }
}

/// A light curve may lie so far off the dense one that this counts.
TEST(LightCurves, AreWhatTheMoveOfTheFairingIsMeasuredFrom) {
  Recipe recipe;
  recipe.construct.lightTolerancePx = 1.0;
  StageCache cache;
  for (const FairingMode mode : kFairingModes) {
    for (const double toleranceMm : {0.002, 0.01, 0.1, 0.5}) {
      SCOPED_TRACE(testing::Message() << "mode " << static_cast<int>(mode) << ", tolerance " << toleranceMm);
      recipe.fairing.mode = mode;
      recipe.fairing.toleranceMm = toleranceMm;
      const auto out = runPipeline(test::ellipseScan(), recipe, cache, {}, {});
      ASSERT_FALSE(out.error);
      const TracedCurve& curve = out.faired->curves.front();
      const double real = apartBothWays(curve.faired, curve.sketched);
      EXPECT_LE(real, 1.001 * toleranceMm);
      EXPECT_NEAR(curve.fairing.maxDeviationMm, real, 0.02 * toleranceMm + 1e-9);
      if (real == 0.0) {
        EXPECT_EQ(curve.faired, curve.sketched);
        EXPECT_FALSE(leftAsDrawnReason(curve).empty());
      }
      EXPECT_LE(curve.fairing.extremaAfter, curve.fairing.extremaBefore);
      EXPECT_EQ(curve.fairing.extremaBefore, curve.sketchedFigures.extrema);
    }
  }
}

TEST(LightCurves, AreWhatTheMoveOfTheTargetsIsMeasuredFrom) {
  Recipe recipe;
  recipe.construct.lightTolerancePx = 1.0;
  recipe.fairing.mode = FairingMode::Target;
  StageCache cache;
  for (const double toleranceMm : {0.01, 0.1, 0.5}) {
    recipe.fairing.toleranceMm = toleranceMm;
    const auto out = runPipeline(test::ellipseScan(), recipe, cache, {}, {});
    ASSERT_FALSE(out.error);
    const TracedCurve& curve = out.faired->curves.front();
    const auto outcomes = targetsFor(curve, {});
    ASSERT_TRUE(outcomes) << outcomes.error().message;
    for (const auto& faired : outcomes->faired) {
      ASSERT_TRUE(faired);
      const double real = apartBothWays(faired->curve, curve.sketched);
      EXPECT_LE(real, 1.001 * toleranceMm);
      EXPECT_NEAR(faired->report.maxDeviationMm, real, 0.02 * toleranceMm + 1e-9);
    }
  }
}

/// A disc, which comes out as an exact circle.
const Scan& discScan() {
  static const Scan scan = [] {
    const auto shape = test::truthShape("circle", 400, 300);
    return test::renderPage(test::fillCoverage(shape.outline(), 400, 300), 400, 300, test::cleanPage());
  }();
  return scan;
}

TEST(LightCurves, ThatAreExactStaySoAndSayWhy) {
  StageCache cache;
  for (const FairingMode mode : {FairingMode::Tolerance, FairingMode::Monotone, FairingMode::LowPass}) {
    Recipe recipe;
    recipe.fairing.mode = mode;
    const auto out = runPipeline(discScan(), recipe, cache, {}, {});
    ASSERT_FALSE(out.error);
    const TracedCurve& curve = out.faired->curves.front();
    ASSERT_TRUE(curve.sketched.isRational());
    EXPECT_EQ(curve.faired, curve.sketched);
    EXPECT_EQ(leftAsDrawnReason(curve), "Unchanged: exact circle.");
  }
}

/// The outline of a log spiral: open lines between its corners.
const Scan& spiralScan() {
  static const Scan scan = [] {
    const auto shape = test::truthShape("logspiral", 400, 300);
    return test::renderPage(test::strokeCoverage(shape.outline(), false, 6.0, 400, 300), 400, 300,
                            test::scannedPage(3));
  }();
  return scan;
}

TEST(LightCurves, KeepTheEndsThatFairingHolds) {
  StageCache cache;
  int held = 0;
  for (const FairingMode mode : kFairingModes) {
    for (const double lightPx : {0.05, 0.5}) {
      SCOPED_TRACE(testing::Message() << "mode " << static_cast<int>(mode) << ", light within " << lightPx);
      Recipe recipe;
      recipe.construct.lightTolerancePx = lightPx;
      recipe.fairing.mode = mode;
      recipe.fairing.toleranceMm = 0.5;
      recipe.fairing.startHold = {.tangent = true, .curvature = true};
      recipe.fairing.endHold.tangent = true;
      const auto out = runPipeline(spiralScan(), recipe, cache, {}, {});
      ASSERT_FALSE(out.error);
      for (const TracedCurve& curve : out.faired->curves) {
        if (curve.closed || curve.faired == curve.sketched) continue;
        ++held;
        const auto directionAt = [](const NurbsCurve& one, double u) {
          return Vec2(one.derivatives(u, 1)[1].normalized());
        };
        const NurbsCurve &was = curve.sketched, &is = curve.faired;
        EXPECT_NEAR(cross(directionAt(was, was.start()), directionAt(is, is.start())), 0.0, 1e-6);
        EXPECT_NEAR(cross(directionAt(was, was.end()), directionAt(is, is.end())), 0.0, 1e-6);
        EXPECT_NEAR(*curvature(is, is.start()), *curvature(was, was.start()), 1e-6);
      }
    }
  }
  EXPECT_GE(held, 4);
}

TEST(LightCurves, AreOfTheTrueAndFairFitOnly) {
  Recipe recipe;
  recipe.construct.light = true;
  recipe.construct.method = ConstructMethod::Nurbs;
  StageCache cache;
  const auto out = runPipeline(test::ellipseScan(), recipe, cache, {}, {});
  ASSERT_FALSE(out.error);
  EXPECT_FALSE(out.faired->curves.front().dense);
  EXPECT_FALSE(out.faired->curves.front().construct.light);
  EXPECT_EQ(out.faired->curves.front().sketched.degree(), 5);
}

TEST(LightCurves, AreTheDefault) {
  EXPECT_TRUE(Recipe{}.construct.light);
  EXPECT_EQ(Recipe{}.construct.detail, 0.0);
}

TEST(LightCurves, DetailRaisesTheToleranceOfAllCurvesOrOfOne) {
  StageCache cache;
  Recipe recipe;
  const auto plain = runPipeline(test::ellipseScan(), recipe, cache, {}, {});
  ASSERT_FALSE(plain.error);
  const TracedCurve& exact = plain.faired->curves.front();
  EXPECT_NEAR(exact.construct.light->tolerancePx, recipe.construct.lightTolerancePx, 1e-9);
  recipe.construct.detail = 0.8;
  const auto calm = runPipeline(test::ellipseScan(), recipe, cache, {}, {});
  ASSERT_FALSE(calm.error);
  const TracedCurve& meant = calm.faired->curves.front();
  const double tolerancePx = meant.construct.light->tolerancePx;
  EXPECT_GT(tolerancePx, 4.0 * recipe.construct.lightTolerancePx);
  EXPECT_LE(meant.construct.light->points, exact.construct.light->points);
  EXPECT_LE(apart(meant.sketched, exact.fairingStart()), 1.3 * tolerancePx * calm.frame.mmPerPx);
  EXPECT_LT(apart(meant.fairingStart(), meant.sketched), 0.01 * calm.frame.mmPerPx)
      << "fairing starts from what the user sees";

  recipe.construct.detail = 0.0;
  const std::size_t own = makeOwnChoice(recipe.choices, *plain.pieces, exact.piece);
  recipe.choices[own].detail = 0.8;
  EXPECT_FALSE(recipe.choices[own].isEmpty());
  const auto one = runPipeline(test::ellipseScan(), recipe, cache, {}, {});
  ASSERT_FALSE(one.error);
  EXPECT_EQ(one.faired->curves.front().sketched, meant.sketched);
  const auto read = recipeFromJson(recipeToJson(recipe));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, recipe);
  recipe.choices[own].detail = 1.5;
  EXPECT_TRUE(validate(recipe));
}

/// A closed blot whose border trembles: its detail is what a larger tolerance leaves away.
const Scan& tremblingScan() {
  static const Scan scan = [] {
    std::vector<Vec2> outline;
    const int steps = 4000;
    for (int i = 0; i < steps; ++i) {
      const double a = 2.0 * std::numbers::pi * i / steps, r = 1.0 + 0.012 * std::sin(23.0 * a);
      outline.push_back(Vec2(200.0, 150.0) + r * Vec2(150.0 * std::cos(a), 100.0 * std::sin(a)));
    }
    return test::renderPage(test::fillCoverage({outline}, 400, 300), 400, 300, test::cleanPage());
  }();
  return scan;
}

TEST(LightCurves, FairingStartsFromWhatTheDetailHasLeftAndIsMeasuredFromIt) {
  for (const double detail : {0.5, 1.0}) {
    Recipe recipe;
    recipe.construct.detail = detail;
    StageCache cache;
    const auto plain = runPipeline(tremblingScan(), recipe, cache, {}, {});
    ASSERT_FALSE(plain.error);
    const TracedCurve& meant = plain.faired->curves.front();
    ASSERT_TRUE(meant.construct.light && meant.construct.light->found);
    for (const FairingMode mode : {FairingMode::Tolerance, FairingMode::Target, FairingMode::Monotone}) {
      recipe.fairing.mode = mode;
      recipe.fairing.toleranceMm = 0.02;
      const auto out = runPipeline(tremblingScan(), recipe, cache, {}, {});
      ASSERT_FALSE(out.error);
      const TracedCurve& curve = out.faired->curves.front();
      EXPECT_EQ(curve.sketched, meant.sketched);
      const double moved = std::max(apart(curve.faired, curve.sketched), apart(curve.sketched, curve.faired));
      EXPECT_LE(moved, 1.001 * recipe.fairing.toleranceMm) << detail;
      EXPECT_NEAR(moved, curve.fairing.maxDeviationMm, 0.05 * recipe.fairing.toleranceMm);
      EXPECT_LE(curve.fairedFigures.extrema, curve.sketchedFigures.extrema) << detail;
      EXPECT_EQ(curve.fairing.extremaBefore, curve.sketchedFigures.extrema);
    }
  }
}

/// A stroke of two bumps: its curvature has three extrema.
Scan roofScan() {
  std::vector<Vec2> line;
  Vec2 at(60.0, 350.0);
  double angle = -0.9;
  constexpr double kStep = 0.5, kLength = 800.0;
  for (double s = 0.0; s <= kLength; s += kStep) {
    line.push_back(at);
    const auto bump = [&](double middle, double width) {
      return std::exp(-std::pow((s / kLength - middle) / width, 2));
    };
    angle += kStep * (0.0015 + 0.004 * bump(0.25, 0.08) + 0.003 * bump(0.75, 0.1));
    at += kStep * Vec2(std::cos(angle), std::sin(angle));
  }
  return test::renderPage(test::strokeCoverage(line, false, 5.0, 900, 560), 900, 560, test::cleanPage());
}

TEST(LightCurves, MonotoneIsReachedWithTheToleranceThatItSaysItNeeds) {
  const Scan scan = roofScan();
  StageCache cache;
  Recipe recipe;
  recipe.construct.detail = 0.5;
  recipe.fairing.mode = FairingMode::Monotone;
  for (const int keep : {0, 1, 2}) {
    recipe.fairing.keepExtrema = {keep};
    recipe.fairing.toleranceMm = 0.01;
    const auto small = runPipeline(scan, recipe, cache, {}, {});
    ASSERT_FALSE(small.error);
    const double needed = small.faired->curves.front().fairing.neededMm.value_or(0.0);
    ASSERT_GT(needed, 0.01);
    recipe.fairing.toleranceMm = needed;
    const auto raised = runPipeline(scan, recipe, cache, {}, {});
    ASSERT_FALSE(raised.error);
    const FairingReport& report = raised.faired->curves.front().fairing;
    EXPECT_LE(report.extremaAfter, keep) << report.note;
    EXPECT_TRUE(report.withinTolerance) << report.note;
    EXPECT_LE(report.maxDeviationMm, recipe.fairing.toleranceMm);
  }
}

}  // namespace
}  // namespace batten
