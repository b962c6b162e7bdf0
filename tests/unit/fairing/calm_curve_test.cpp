// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/calm_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing.h"
#include "core/fairing/target_splits.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

/// An arch of 230 mm as a hand draws it that trembles by 0.1 mm.
NurbsCurve tremblingArch(unsigned seed) {
  const auto arch = [](double t) { return Vec2(230.0 * t, 100.0 * std::sin(std::numbers::pi * t)); };
  return test::noisy(test::fitted(arch, 90), 0.1, seed);
}

FairingParams toTargetOf(int number, double toleranceMm) {
  FairingParams params;
  params.mode = FairingMode::Target;
  params.target = *targetOfNumber(number);
  params.toleranceMm = toleranceMm;
  return params;
}

TEST(CalmCurve, LiesOnTheArchThatWasMeantWithoutItsTremor) {
  for (const unsigned seed : {1u, 7u, 23u}) {
    SCOPED_TRACE(seed);
    const NurbsCurve line = tremblingArch(seed);
    ASSERT_GT(countedExtrema(line, false), kMostSplits);
    const auto calm = withoutTremor(line, false, toTargetOf(0, 1.0));
    ASSERT_TRUE(calm);
    EXPECT_LT(3 * countedExtrema(*calm, false), countedExtrema(line, false));
    const auto arch = [](double t) { return Vec2(230.0 * t, 100.0 * std::sin(std::numbers::pi * t)); };
    EXPECT_LE(deviation(*calm, test::fitted(arch, 90)).max, 0.3);
  }
}

TEST(CalmCurve, IsNoneWhereTheBendsAreMeant) {
  // 40 waves of 2 mm: none of them is tremor.
  const auto waves = [](double t) { return Vec2(400.0 * t, 2.0 * std::sin(80.0 * std::numbers::pi * t)); };
  const NurbsCurve line = test::fitted(waves, 500);
  ASSERT_GT(countedExtrema(line, false), kMostSplits);
  EXPECT_FALSE(withoutTremor(line, false, toTargetOf(0, 1.0)));
  EXPECT_FALSE(withoutTremor(test::wave(200.0, 10.0, 30), false, toTargetOf(0, 1.0))) << "it has a few bends only";
}

TEST(CalmCurve, IsNotForWhatIsDoneAsInThePapers) {
  const NurbsCurve line = tremblingArch(7);
  FairingParams whole = toTargetOf(0, 1.0), radii = whole, edgeLengths = whole;
  edgeLengths.means = FairingMeans::EdgeLengths;
  whole.targets.spans = TargetSpans::Whole;
  radii.targets.quantity = TargetQuantity::Radius;
  EXPECT_FALSE(withoutTremor(line, false, whole));
  EXPECT_FALSE(withoutTremor(line, false, radii));
  EXPECT_FALSE(withoutTremor(line, false, edgeLengths));
  EXPECT_EQ(targetStart(line, false, whole), line);
}

TEST(CalmCurve, TargetsOfALineThatTremblesLeaveAFewExtrema) {
  const NurbsCurve line = tremblingArch(7);
  for (const int number : {0, 1, 3, 6}) {
    SCOPED_TRACE(number);
    const auto faired = fair(line, false, toTargetOf(number, 1.0), {});
    ASSERT_TRUE(faired) << faired.error().message;
    EXPECT_LE(faired->report.extremaAfter, 6) << faired->report.note;
    EXPECT_LE(deviation(faired->curve, line).max, 1.0);
    EXPECT_LE(deviation(line, faired->curve).max, 1.001);
    if (number == 0) {
      EXPECT_TRUE(faired->report.withinTolerance) << faired->report.note;
    }
  }
}

TEST(CalmCurve, TilesAndAClickOnOneGiveTheSame) {
  const NurbsCurve line = tremblingArch(7);
  const auto tiles = fairAllTargets(line, false, toTargetOf(0, 1.0), {});
  ASSERT_TRUE(tiles);
  EXPECT_EQ(tiles->splits, targetSplits(line, false, toTargetOf(0, 1.0)));
  for (const int degree : {2, 4}) {
    const auto chosen = fair(line, false, toTargetOf(degree, 1.0), {});
    ASSERT_TRUE(chosen);
    ASSERT_TRUE(tiles->faired[degree - 1]);
    EXPECT_EQ(chosen->curve, tiles->faired[degree - 1]->curve);
    EXPECT_EQ(chosen->report.neededMm, tiles->faired[degree - 1]->report.neededMm);
  }
}

}  // namespace
}  // namespace batten
