// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/corner_sections.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/curve/closest_point.h"
#include "core/curve/corners_inside.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/fairing/followed_target.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

NurbsCurve moved(const NurbsCurve& curve, double angle, const Vec2& to) {
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const Vec2 first = turn * curve.point(curve.start());
  return curve.mapped(turn, to - first);
}

/// Two trembling arcs that meet in a sharp corner.
NurbsCurve twoArcs() {
  const NurbsCurve first = test::noisy(test::arc(60.0, 1.2, 20), 0.02, 3);
  const NurbsCurve second = moved(test::noisy(test::arc(90.0, 0.9, 20), 0.02, 4), 2.4, first.point(first.end()));
  return joinAtCorners(std::array{first, second}, 1e-9).value();
}

FairingParams asked(FairingMode mode, double toleranceMm) {
  FairingParams params;
  params.mode = mode;
  params.toleranceMm = toleranceMm;
  return params;
}

TEST(CornerSections, CutACurveAtItsCorners) {
  const NurbsCurve curve = twoArcs();
  const auto sections = cornerSections(curve, false);
  ASSERT_EQ(sections.size(), 2u);
  EXPECT_EQ(sections[0].span.from, 0.0);
  EXPECT_EQ(sections[0].span.to, sections[1].span.from);
  EXPECT_EQ(sections[1].span.to, 1.0);
  EXPECT_NEAR(sections[0].span.to, 72.0 / (72.0 + 81.0), 0.01);
  EXPECT_TRUE(cornerSections(test::arc(60.0, 1.0, 12), false).empty());
}

/// Trembling arches with a corner between them and a split in the first: the second is faired with one polynomial, to
/// its own curvature.
TEST(CornerSections, TheTargetShownIsTheOneThatEachPartFollows) {
  const auto arch = [](double t) { return Vec2(230.0 * t, 100.0 * std::sin(std::numbers::pi * t)); };
  const NurbsCurve first = test::noisy(test::fitted(arch, 90), 0.1, 7);
  const NurbsCurve second = moved(test::noisy(test::fitted(arch, 90), 0.1, 8), 2.4, first.point(first.end()));
  const NurbsCurve curve = joinAtCorners(std::array{first, second}, 1e-9).value();
  FairingParams params = asked(FairingMode::Target, 1.0);
  params.target = *targetOfNumber(3);
  params.targets.splits = {0.2};
  const auto faired = fairBetweenCorners(curve, false, params, {});
  ASSERT_TRUE(faired && faired->report.targetDegree);
  const auto shown = followedTarget(curve, false, params, faired->report);
  const auto sections = cornerSections(curve, false);
  ASSERT_TRUE(shown && sections.size() == 2);
  const FairingParams own = paramsOfSection(params, sections[1], false);
  const auto alone = fair(sections[1].curve, false, own, {});
  ASSERT_TRUE(alone && alone->report.targetDegree);
  const auto followed = followedTarget(sections[1].curve, false, own, alone->report);
  ASSERT_TRUE(followed);
  double peak = 0.0, apart = 0.0;
  for (int i = 1; i < 20; ++i) {
    const double x = i / 20.0, wanted = followed->curvatureAt(x);
    peak = std::max(peak, std::abs(wanted));
    apart = std::max(apart,
                     std::abs(shown->curvatureAt(sections[1].span.from + x * (1.0 - sections[1].span.from)) - wanted));
  }
  EXPECT_LT(apart, 0.02 * peak);
}

TEST(CornerSections, EveryWayOfFairingKeepsTheCornerSharpAndInItsPlace) {
  const NurbsCurve curve = twoArcs();
  const Vec2 corner = curve.point(cornersInside(curve).front());
  const int before = countedExtrema(curve, false);
  for (const FairingMode mode :
       {FairingMode::Tolerance, FairingMode::Target, FairingMode::Monotone, FairingMode::LowPass}) {
    const auto faired = fairBetweenCorners(curve, false, asked(mode, 0.3), {});
    ASSERT_TRUE(faired) << faired.error().message;
    const auto corners = cornersInside(faired->curve);
    ASSERT_EQ(corners.size(), 1u);
    EXPECT_LT((faired->curve.point(corners.front()) - corner).norm(), 1e-9);
    EXPECT_LE(faired->report.maxDeviationMm, 0.3);
    EXPECT_EQ(faired->report.extremaBefore, before);
    EXPECT_LT(faired->report.extremaAfter, before);
    EXPECT_EQ(countedExtrema(faired->curve, false), faired->report.extremaAfter);
    EXPECT_NEAR(deviation(faired->curve, curve).max, faired->report.maxDeviationMm, 0.02);
  }
}

TEST(CornerSections, TilesShowWhatChoosingThemGives) {
  const NurbsCurve curve = twoArcs();
  FairingParams params = asked(FairingMode::Target, 0.3);
  const TargetsJob job{curve, false, params};
  const auto outcomes = targetsBetweenCorners(std::span(&job, 1), {});
  ASSERT_TRUE(outcomes.front());
  const TargetOutcomes& all = *outcomes.front();
  const double at = cornerSections(curve, false)[0].span.to;
  EXPECT_TRUE(std::any_of(all.splits.begin(), all.splits.end(), [&](double f) { return std::abs(f - at) < 1e-9; }));
  for (int degree = 1; degree <= 6; ++degree) {
    params.target = targetOfDegree(degree);
    const auto chosen = fairBetweenCorners(curve, false, params, {});
    ASSERT_TRUE(chosen);
    const int index = degree - 1;
    ASSERT_TRUE(all.faired[index]);
    EXPECT_EQ(all.faired[index]->curve, chosen->curve) << degree;
    EXPECT_EQ(all.faired[index]->report.extremaAfter, chosen->report.extremaAfter);
    ASSERT_TRUE(all.targets.profiles[index].valid);
    EXPECT_EQ(all.targets.profiles[index].nodes.front().f, 0.0);
    EXPECT_NEAR(all.targets.profiles[index].nodes.back().f, 1.0, 1e-12);
  }
}

TEST(CornerSections, ASpanThatIsPointedAtLeavesTheOtherSideAlone) {
  const NurbsCurve curve = twoArcs();
  TargetsJob job{curve, false, asked(FairingMode::Target, 0.3)};
  job.spanAt = 0.9;
  const auto outcomes = targetsBetweenCorners(std::span(&job, 1), {});
  ASSERT_TRUE(outcomes.front());
  const double corner = cornerSections(curve, false)[0].span.to;
  ASSERT_TRUE((*outcomes.front()).span);
  EXPECT_GE((*outcomes.front()).span->from, corner - 1e-9);
  for (const auto& faired : (*outcomes.front()).faired) {
    ASSERT_TRUE(faired);
    for (const double f : {0.1, 0.3, 0.45}) {
      const Vec2 p = curve.point(curve.start() + f * (cornersInside(curve).front() - curve.start()));
      EXPECT_LT(closestPoint(faired->curve, p).distance, 1e-9);
    }
  }
}

TEST(CornerSections, AStraightSideStaysStraight) {
  const NurbsCurve side = test::fitted([](double t) { return Vec2(50.0 * t, 0.0); }, 12);
  const NurbsCurve bow = moved(test::noisy(test::arc(60.0, 1.2, 20), 0.02, 3), 1.0, Vec2(50.0, 0.0));
  const NurbsCurve curve = joinAtCorners(std::array{side, bow}, 1e-9).value();
  const auto faired = fairBetweenCorners(curve, false, asked(FairingMode::Tolerance, 0.2), {});
  ASSERT_TRUE(faired);
  for (double x = 5.0; x < 50.0; x += 5.0) EXPECT_LT(closestPoint(faired->curve, Vec2(x, 0.0)).distance, 1e-9);
  EXPECT_LT(faired->report.extremaAfter, faired->report.extremaBefore);
}

}  // namespace
}  // namespace batten
