// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_chain.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/curve/knot_operations.h"
#include "tests/unit/construct/light_shapes.h"

namespace batten {
namespace {

constexpr int kSteps = 24000;

/// A line whose curvature turns back again and again: a bow with waves, 900 px long.
test::TruthPiece wavyLine(int waves) {
  test::TruthPiece piece;
  const double length = 900.0, step = length / kSteps;
  Vec2 p = Vec2::Zero();
  double angle = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double f = static_cast<double>(i) / kSteps;
    const double kappa = 1.2e-3 + 4e-3 * std::sin(2.0 * std::numbers::pi * waves * f) * (1.0 + 0.3 * std::cos(9.0 * f));
    piece.points.push_back(p);
    piece.kappa.push_back(kappa);
    angle += 0.5 * step * kappa;
    p += step * Vec2(std::cos(angle), std::sin(angle));
    angle += 0.5 * step * kappa;
  }
  return piece;
}

/// A ring with waves: 2 extrema each.
test::TruthPiece wavyRing(int waves) {
  test::TruthPiece piece;
  for (int i = 0; i < kSteps; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSteps;
    piece.points.push_back((150.0 + 4.0 * std::cos(waves * a)) * Vec2(std::cos(a), std::sin(a)));
  }
  return piece;
}

LightOptions lightWithin(double tolerance) {
  LightOptions options;
  options.tolerance = tolerance;
  return options;
}

void expectStandsFor(const LightCurve& light, const NurbsCurve& dense, bool closed, double tolerance) {
  EXPECT_LE(test::farthestFrom(test::pointsOn(dense, 5000), test::pointsOn(light.curve, 600)), tolerance + 1e-3);
  EXPECT_LE(test::farthestFrom(test::pointsOn(light.curve, 5000), test::pointsOn(dense, 600)), tolerance + 1e-3);
  const double prominence = 5e-3 / 900.0;
  EXPECT_LE(test::countExtrema(test::curvaturesOn(light.curve, 12001, closed), prominence, closed),
            test::countExtrema(test::curvaturesOn(dense, 12001, closed), prominence, closed));
}

double kappaAt(const NurbsCurve& curve, double u) {
  const auto d = curve.derivatives(u, 2);
  return cross(d[1], d[2]) / std::pow(d[1].norm(), 3);
}

TEST(LightChain, MakesLinesOfManyExtremaLight) {
  const NurbsCurve dense = test::denseCurve(wavyLine(12), false);
  LightOptions options = lightWithin(0.1);
  options.start = LightHold::Curvature;
  options.end = LightHold::Tangent;
  const auto light = makeLight(dense, false, options, {});
  ASSERT_TRUE(light);
  ASSERT_EQ(light->report.kind, LightKind::Chain);
  EXPECT_GT(light->report.sections, 2);
  EXPECT_EQ(light->report.sectionsDense, 0);
  EXPECT_EQ(light->report.obstacle, LightObstacle::None);
  EXPECT_EQ(light->report.points, light->curve.controlPointCount());
  EXPECT_LT(3 * light->report.points, light->report.pointsBefore);
  expectStandsFor(*light, dense, false, 0.1);
  for (const bool atEnd : {false, true}) {
    const auto a = light->curve.derivatives(atEnd ? light->curve.end() : light->curve.start(), 1);
    const auto b = dense.derivatives(atEnd ? dense.end() : dense.start(), 1);
    EXPECT_LT((a[0] - b[0]).norm(), 1e-9);
    EXPECT_LT(std::abs(cross(a[1].normalized(), b[1].normalized())), 1e-9);
  }
  EXPECT_NEAR(kappaAt(light->curve, light->curve.start()), kappaAt(dense, dense.start()), 1e-9);
}

TEST(LightChain, ItsSectionsMeetWithOneTangentAndCurvature) {
  const NurbsCurve dense = test::denseCurve(wavyLine(9), false);
  const auto light = makeLight(dense, false, lightWithin(0.1), {});
  ASSERT_TRUE(light);
  ASSERT_EQ(light->report.kind, LightKind::Chain);
  const auto breaks = light->curve.breaks();
  const double length = light->curve.end() - light->curve.start();
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const auto before = light->curve.derivatives(breaks[i] - 1e-9 * length, 1);
    const auto after = light->curve.derivatives(breaks[i], 1);
    EXPECT_LT(std::abs(cross(before[1].normalized(), after[1].normalized())), 1e-6);
    EXPECT_NEAR(kappaAt(light->curve, breaks[i] - 1e-9 * length), kappaAt(light->curve, breaks[i]), 1e-6);
  }
}

TEST(LightChain, GoesRoundClosedCurves) {
  const NurbsCurve dense = test::denseCurve(wavyRing(11), true);
  const auto light = makeLight(dense, true, lightWithin(0.1), {});
  ASSERT_TRUE(light);
  ASSERT_EQ(light->report.kind, LightKind::Chain);
  EXPECT_LT(2 * light->report.points, light->report.pointsBefore);
  expectStandsFor(*light, dense, true, 0.1);
  const auto first = light->curve.derivatives(light->curve.start(), 1);
  const auto last = light->curve.derivatives(light->curve.end(), 1);
  EXPECT_LT((first[0] - last[0]).norm(), 1e-9);
  EXPECT_LT(std::abs(cross(first[1].normalized(), last[1].normalized())), 1e-9);
  EXPECT_NEAR(kappaAt(light->curve, light->curve.start()), kappaAt(light->curve, light->curve.end()), 1e-9);
}

TEST(LightChain, IsTheSameWhateverTheNumberOfThreads) {
  const NurbsCurve dense = test::denseCurve(wavyLine(15), false);
  std::optional<LightCurve> first;
  for (const int threads : {1, 2, 4}) {
    RunContext context;
    context.threads = threads;
    auto light = makeLight(dense, false, lightWithin(0.1), context);
    ASSERT_TRUE(light);
    if (first) {
      EXPECT_EQ(light->curve, first->curve);
    } else {
      first = std::move(*light);
    }
  }
}

/// What one cuts and joins again is the same curve, with the same number of control points but one at each joint.
TEST(LightChain, JoiningUndoesCutting) {
  const NurbsCurve dense = test::denseCurve(wavyLine(3), false);
  const double length = dense.end() - dense.start();
  std::vector<NurbsCurve> parts;
  NurbsCurve rest = dense;
  for (const double share : {0.21, 0.5, 0.83}) {
    const auto halves = split(rest, dense.start() + share * length);
    ASSERT_TRUE(halves);
    // Another speed in every part: the joint has to find the common one.
    const auto faster = reparametrized(halves->left, 0.0, (0.4 + share) * length);
    ASSERT_TRUE(faster);
    parts.push_back(*faster);
    rest = halves->right;
  }
  parts.push_back(rest);
  int points = 0;
  for (const NurbsCurve& part : parts) points += part.controlPointCount();
  const auto joined = joinedWithTangents(parts);
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->controlPointCount(), points - 2 * 3);
  // The polylines have sagittas.
  EXPECT_LT(test::farthestFrom(test::pointsOn(dense, 20000), test::pointsOn(*joined, 500)), 1e-4);
  EXPECT_LT(test::farthestFrom(test::pointsOn(*joined, 20000), test::pointsOn(dense, 500)), 1e-4);
  // A corner has no common tangent.
  Eigen::Matrix2d turn;
  turn << 0.9, -0.4, 0.4, 0.9;
  const Vec2 end = parts[0].point(parts[0].end()), start = parts[1].point(parts[1].start());
  EXPECT_FALSE(joinedWithTangents({parts[0], parts[1].mapped(turn, end - turn * start)}));
}

/// Two straight lines with a rounding of 0.8 px between them: the samples have to lie close there.
TEST(LightReference, FollowsTightTurns) {
  const double radius = 0.8;
  test::TruthPiece piece;
  for (int i = 0; i <= 400; ++i) piece.points.emplace_back(-40.0 + 0.1 * i, 0.0);
  for (int i = 1; i <= 60; ++i) {
    const double a = 0.5 * std::numbers::pi * i / 60.0;
    piece.points.emplace_back(radius * std::sin(a), radius * (1.0 - std::cos(a)));
  }
  for (int i = 1; i <= 400; ++i) piece.points.emplace_back(radius, radius + 0.1 * i);
  std::vector<double> t(1, 0.0);
  for (std::size_t i = 1; i < piece.points.size(); ++i) {
    t.push_back(t.back() + (piece.points[i] - piece.points[i - 1]).norm());
  }
  std::vector<double> weights(t.size(), 1.0);
  const auto fitted = fitUniformQuintic({t.back(), 160, false}, t, piece.points, weights, 1e-9);
  ASSERT_TRUE(fitted);
  const auto curve = fitted->toNurbs();
  ASSERT_TRUE(curve);
  const auto reference = LightReference::make(*curve, false, 0.5);
  ASSERT_TRUE(reference);
  double sharpest = 1.0;
  for (int i = 1; i < reference->size(); ++i) {
    EXPECT_GT(reference->at(i).u, reference->at(i - 1).u);
    EXPECT_LT((reference->at(i).point - reference->at(i - 1).point).norm(), 0.51);
    sharpest = std::min(sharpest, reference->at(i).tangent.dot(reference->at(i - 1).tangent));
  }
  EXPECT_GT(sharpest, 0.984);
  EXPECT_NEAR(reference->length(), t.back(), 0.05);
}

// A spiral has no extrema at which it could be cut: without other cuts the search over all of it would take time with
// the square of its length.
TEST(LightChain, LongStretchesWithoutExtremaAreDivided) {
  constexpr int kQuintic = 5, kSpans = 3 * kMostSectionSpans + 50;
  std::vector<double> knots(kQuintic, 0.0);
  std::vector<Vec2> points;
  for (int i = 0; i <= kSpans; ++i) knots.push_back(i);
  knots.insert(knots.end(), kQuintic, kSpans);
  for (int i = 0; i < kSpans + kQuintic; ++i) {
    const double angle = std::sqrt(0.5 * i + 20.0);
    points.emplace_back(5.0 * angle * std::cos(angle), 5.0 * angle * std::sin(angle));
  }
  const auto curve = NurbsCurve::make(kQuintic, std::move(knots), std::move(points));
  ASSERT_TRUE(curve);
  LightOptions options;
  const auto reference = LightReference::make(*curve, false, options.step);
  ASSERT_TRUE(reference);
  std::vector<double> ends = lightSections(*curve, *reference, options).cuts;
  EXPECT_GE(ends.size(), 3u);
  ends.push_back(curve->end());
  double from = curve->start();
  for (const double to : ends) {
    EXPECT_LE(to - from, kMostSectionSpans + 1e-9);
    from = to;
  }
}

// Each section takes many milliseconds: a line of thousands of waves would hold everything up for minutes.
TEST(LightChain, ACurveOfTooManySectionsStaysDense) {
  constexpr int kQuintic = 5, kSpans = 6000;
  std::vector<double> knots(kQuintic, 0.0);
  std::vector<Vec2> points;
  for (int i = 0; i <= kSpans; ++i) knots.push_back(3.0 * i);
  knots.insert(knots.end(), kQuintic, 3.0 * kSpans);
  for (int i = 0; i < kSpans + kQuintic; ++i) points.emplace_back(3.0 * i, i % 6 < 3 ? 0.0 : 6.0);
  const auto curve = NurbsCurve::make(kQuintic, std::move(knots), std::move(points));
  ASSERT_TRUE(curve);
  const auto light = makeLight(*curve, false, lightWithin(0.05), {});
  ASSERT_TRUE(light);
  EXPECT_EQ(light->report.kind, LightKind::Dense);
  EXPECT_EQ(light->report.obstacle, LightObstacle::Effort);
  EXPECT_EQ(light->curve, *curve);
}

}  // namespace
}  // namespace batten
