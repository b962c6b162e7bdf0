// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_curve.h"
#include "core/construct/typical/typical_chain.h"

#include <gtest/gtest.h>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "tests/support/known_answers.h"
#include "tests/unit/construct/any_pieces.h"
#include "tests/unit/construct/roof_line.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

using std::numbers::pi;

NurbsCurve asCurve(const TypicalCurve& typical) {
  const auto q = typical.controlPoints();
  return NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, {q.begin(), q.end()}).value();
}

TEST(TypicalCurve, MatchesTheKnownAnswer) {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "05_typical.json");
  for (const auto& item : answer.at("cases")) {
    const auto number = [&](const char* key) { return item.at(key).get<double>(); };
    const auto made = typicalFromForm(Vec2::Zero(), 0.0, number("kappa0"), number("dS"), number("dW"));
    ASSERT_TRUE(made);
    EXPECT_NEAR(made->edge, number("l"), 1e-10 * number("l"));
    EXPECT_NEAR(made->ratio, number("h"), 1e-10 * number("h"));
    EXPECT_NEAR(made->turnRad, number("phi"), 1e-10);
    EXPECT_EQ(made->isMonotone(), item.at("monotone").get<bool>());
    EXPECT_NEAR(made->endCurvature(), number("kappa1"), 1e-10 * std::abs(number("kappa1")));
    const auto curve = asCurve(*made);
    for (std::size_t i = 0; i < item.at("u").size(); ++i) {
      const double u = item.at("u").at(i), kappa = item.at("kappa").at(i);
      EXPECT_LT((curve.point(u) - test::toVec2(item.at("points").at(i))).norm(), 1e-10 * number("dS"));
      EXPECT_NEAR(curvature(curve, u).value(), kappa, 1e-9 * std::abs(kappa));
    }
    const auto longer = made->toParameter(1.25);
    const auto& extrapolated = item.at("extrapolated_to_u_1_25");
    EXPECT_NEAR(longer.edge, extrapolated.at("l").get<double>(), 1e-9 * longer.edge);
    EXPECT_NEAR(longer.ratio, extrapolated.at("h").get<double>(), 1e-9);
    EXPECT_NEAR(longer.turnRad, extrapolated.at("phi").get<double>(), 1e-9);
    // The other way to the same curve: from the curvatures of both ends.
    const auto again =
        typicalFromCurvatures(Vec2::Zero(), 0.0, made->startCurvature(), made->endCurvature(), number("dW"));
    ASSERT_TRUE(again);
    EXPECT_NEAR(again->edge, made->edge, 1e-10 * made->edge);
    EXPECT_NEAR(again->ratio, made->ratio, 1e-10);
  }
}

TEST(TypicalCurve, MonotoneMeansNoExtremumInside) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const TypicalCurve typical{{0, 0}, 0.0, 20.0, 0.5 + 1.5 * unit(random), 0.05 + unit(random)};
    const auto extrema = curvatureExtrema(asCurve(typical), 1e-9 * std::abs(typical.startCurvature()), false);
    EXPECT_EQ(extrema.empty(), typical.isMonotone()) << typical.ratio << " " << typical.turnRad;
  }
}

TEST(TypicalCurve, TruncatedAndExtrapolatedLieOnTheSameCubic) {
  const auto typical = typicalFromForm({3, 4}, 0.3, 0.01, 80.0, 0.7).value();
  const auto half = asCurve(typical.toParameter(0.5)), whole = asCurve(typical);
  const auto back = typical.toParameter(1.6).toParameter(1.0 / 1.6);
  EXPECT_NEAR(back.edge, typical.edge, 1e-12 * typical.edge);
  EXPECT_NEAR(back.ratio, typical.ratio, 1e-12);
  for (int i = 0; i <= 10; ++i) EXPECT_LT((half.point(i / 10.0) - whole.point(i / 20.0)).norm(), 1e-12);
}

TEST(TypicalCurve, AbsentWhereThereIsNone) {
  EXPECT_FALSE(typicalFromForm({0, 0}, 0, 0.0, 80, 0.7));
  EXPECT_FALSE(typicalFromForm({0, 0}, 0, 0.01, 80, 0.0));
  EXPECT_FALSE(typicalFromForm({0, 0}, 0, 0.01, 80, -0.7));
  EXPECT_FALSE(typicalFromForm({0, 0}, 0, 0.01, 0.0, 0.7));
  EXPECT_FALSE(typicalFromForm({0, 0}, 0, 0.01, 80, 3.2));
  EXPECT_FALSE(typicalFromCurvatures({0, 0}, 0, 0.01, -0.01, 0.7));
}

double largestJump(const NurbsCurve& curve) {
  double jump = 0.0;
  const auto breaks = curve.breaks();
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const double h = 1e-7 * (breaks[i] - breaks[i - 1]);
    jump = std::max(jump, std::abs(curvature(curve, breaks[i]).value() - curvature(curve, breaks[i] - h).value()));
  }
  return jump;
}

TEST(ConstructTypical, IsTrueAndHasNoJumpOfCurvature) {
  const auto open = test::pieceOf(test::roofLine, 0, 900, 30, false);
  const auto line = constructTypical(open, {}, {}).value();
  EXPECT_LT(deviation(line.curve, positionsOf(open.points), true).max, 1.0);
  EXPECT_LT(largestJump(line.curve), 1e-6);
  EXPECT_EQ(line.curve.point(line.curve.start()), open.stations.front().point);
  EXPECT_EQ(line.curve.point(line.curve.end()), open.stations.back().point);
  const auto quarter = test::pieceOf(test::ellipsePoint, 0.1, 1.45, 10, false);
  const auto arc = constructTypical(quarter, {}, {}).value();
  EXPECT_LT(deviation(arc.curve, positionsOf(quarter.points), true).max, 0.3);
  EXPECT_TRUE(curvatureExtrema(arc.curve, 5e-3 / extent(arc.curve), false).empty());
  const auto closed = test::pieceOf(test::ellipsePoint, 0, 2 * pi, 36, true);
  const auto around = constructTypical(closed, {}, {}).value();
  EXPECT_LT(deviation(around.curve, positionsOf(closed.points), true).max, 1.0);
  EXPECT_LT(largestJump(around.curve), 1e-6);
  EXPECT_NEAR(curvature(around.curve, around.curve.start()).value(),
              curvature(around.curve, around.curve.end()).value(), 1e-9);
}

TEST(ConstructTypical, MakesMostOfASmoothLineOfTypicalCurves) {
  // A roof: nearly an arc of a circle, with two bends on it [1/px], 800 px long. A chain laid along it alone takes the
  // stretches of nearly even curvature for transitions.
  const auto kappaAt = [](double share) {
    return 0.0015 + 0.004 * std::exp(-std::pow((share - 0.25) / 0.08, 2)) +
           0.003 * std::exp(-std::pow((share - 0.75) / 0.1, 2));
  };
  constexpr double kLengthPx = 800.0;
  constexpr int kSteps = 1600;
  std::vector<Vec2> course{Vec2(60.0, 350.0)};
  double angle = -0.9;
  for (int i = 0; i < kSteps; ++i) {
    const double turn = kappaAt((i + 0.5) / kSteps) * kLengthPx / kSteps;
    course.push_back(course.back() +
                     kLengthPx / kSteps * Vec2(std::cos(angle + turn / 2.0), std::sin(angle + turn / 2.0)));
    angle += turn;
  }
  const auto at = [&](double t) { return course[std::lround(t * kSteps)]; };
  for (const unsigned seed : {1u, 2u, 3u}) {
    auto piece = test::pieceOf(at, 0.0, 1.0, 16, false);
    const auto truth = positionsOf(piece.points);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 0.1);
    for (PiecePoint& p : piece.points) p.at += Vec2(noise(random), noise(random));
    const auto made = constructTypical(piece, {}, {}).value();
    EXPECT_GE(typicalShare(made.report.segments), 0.6) << made.report.note << " seed " << seed;
    EXPECT_LT(deviation(made.curve, truth, true).rms, 0.1);
  }
}

TEST(ConstructTypical, ComesToRestOnAnOrdinaryLine) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.3);
  auto piece =
      test::pieceOf([](double t) { return Vec2(300.0 * std::cos(t), 90.0 * std::sin(t)); }, 0.0, 2.0 * pi, 36, true);
  const auto truth = positionsOf(piece.points);
  for (PiecePoint& p : piece.points) p.at += Vec2(noise(random), noise(random));
  const auto made = constructTypical(piece, {}, {}).value();
  EXPECT_EQ(made.report.why, Termination::Converged);
  EXPECT_LT(deviation(made.curve, truth, true).rms, 0.1);
}

TEST(ConstructTypical, AnythingGivesAFiniteCurveOrAnError) {
  test::expectFiniteOrError(120, [](const ConstructPiece& piece) { return constructTypical(piece, {}, {}); });
}

}  // namespace
}  // namespace batten
