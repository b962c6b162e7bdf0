// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_curve.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

#include "core/curve/knot_operations.h"
#include "tests/unit/construct/light_shapes.h"

namespace batten {
namespace {

constexpr int kWidth = 800, kHeight = 600;
constexpr double kTolerances[] = {1.0, 0.5, 0.2, 0.05};

LightOptions within(double tolerance) {
  LightOptions options;
  options.tolerance = tolerance;
  return options;
}

struct Needed {
  const char* shape;
  int points[4];  ///< For the tolerances above; the fewest known for such shapes, exact lines 2, arcs 3.
};
std::ostream& operator<<(std::ostream& out, const Needed& needed) { return out << needed.shape; }

class LightShapes : public ::testing::TestWithParam<Needed> {};

TEST_P(LightShapes, NeedFewPointsAndKeepTheirCurvature) {
  const Needed needed = GetParam();
  const auto truth = test::truthShape(needed.shape, kWidth, kHeight);
  const bool closed = truth.corners.empty();
  for (std::size_t t = 0; t < std::size(kTolerances); ++t) {
    SCOPED_TRACE(kTolerances[t]);
    int points = 0;
    for (const test::TruthPiece& piece : truth.pieces) {
      const NurbsCurve dense = test::denseCurve(piece, closed);
      const auto light = makeLight(dense, closed, within(kTolerances[t]), {});
      ASSERT_TRUE(light) << light.error().message;
      points += light->report.points;
      EXPECT_LE(light->report.points, light->report.pointsBefore);
      auto line = test::pointsOn(light->curve, 4000);
      std::vector<Vec2> asked = piece.points;
      if (closed) asked.push_back(asked.front());
      std::vector<Vec2> some;
      for (std::size_t i = 0; i < asked.size(); i += 97) some.push_back(asked[i]);
      EXPECT_LE(test::farthestFrom(line, some), kTolerances[t] + 0.01);
      std::vector<Vec2> places = test::pointsOn(light->curve, 300);
      std::vector<Vec2> course;
      for (std::size_t i = 0; i < asked.size(); i += 10) course.push_back(asked[i]);
      course.push_back(asked.back());
      EXPECT_LE(test::farthestFrom(course, places), kTolerances[t] + 0.01);
      const double prominence = 5e-3 / truth.diagonal();
      EXPECT_LE(test::countExtrema(test::curvaturesOn(light->curve, 6001, closed), prominence, closed),
                test::countExtrema(piece.kappa, prominence, closed));
      if (!closed) {
        EXPECT_LT((light->curve.point(light->curve.start()) - dense.point(dense.start())).norm(), 1e-9);
        EXPECT_LT((light->curve.point(light->curve.end()) - dense.point(dense.end())).norm(), 1e-9);
      }
    }
    EXPECT_LE(points, needed.points[t]);
  }
}

INSTANTIATE_TEST_SUITE_P(Nine, LightShapes,
                         ::testing::Values(Needed{"circle", {3, 3, 3, 3}}, Needed{"ellipse", {4, 4, 5, 6}},
                                           Needed{"clothoid", {8, 8, 9, 9}}, Needed{"logspiral", {8, 8, 8, 9}},
                                           Needed{"scurve", {14, 14, 14, 14}}, Needed{"superell", {10, 10, 11, 14}},
                                           Needed{"car", {19, 19, 20, 25}}, Needed{"K", {33, 33, 33, 35}},
                                           Needed{"crown", {21, 21, 22, 23}}),
                         [](const auto& one) { return one.param.shape; });

/// An open line of random curvature: a few waves of random height.
test::TruthPiece randomLine(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, 1.0), height(-4.0, 4.0);
  const int waves = 2 + static_cast<int>(seed % 4);
  std::vector<Vec2> bumps;
  for (int i = 0; i < waves; ++i) bumps.emplace_back(place(random), height(random));
  test::TruthPiece piece;
  const double length = 300.0 + 500.0 * place(random);
  const int steps = 6000;
  Vec2 p = Vec2::Zero();
  double angle = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double f = static_cast<double>(i) / steps;
    double turn = 0.8;
    for (const Vec2& bump : bumps) turn += bump.y() * std::exp(-0.5 * std::pow((f - bump.x()) / 0.12, 2));
    piece.points.push_back(p);
    piece.kappa.push_back(turn / length);
    const double step = length / steps;
    angle += 0.5 * step * turn / length;
    p += step * Vec2(std::cos(angle), std::sin(angle));
    angle += 0.5 * step * turn / length;
  }
  return piece;
}

TEST(LightCurve, NeverAddsExtremaNorLeavesTheToleranceOfRandomLines) {
  int before = 0, after = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const auto line = randomLine(seed);
    const NurbsCurve dense = test::denseCurve(line, false);
    const double tolerance = seed % 2 == 0 ? 0.2 : 0.05;
    const auto light = makeLight(dense, false, within(tolerance), {});
    ASSERT_TRUE(light);
    EXPECT_LE(test::farthestFrom(test::pointsOn(dense, 4000), test::pointsOn(light->curve, 250)), tolerance + 1e-3);
    EXPECT_LE(test::farthestFrom(test::pointsOn(light->curve, 4000), test::pointsOn(dense, 250)), tolerance + 1e-3);
    const double prominence = 5e-3 / 600.0;
    EXPECT_LE(test::countExtrema(test::curvaturesOn(light->curve, 4001, false), prominence, false),
              test::countExtrema(test::curvaturesOn(dense, 4001, false), prominence, false));
    before += light->report.pointsBefore;
    after += light->report.points;
  }
  EXPECT_LT(8 * after, before) << "hardly a point was spared";
}

TEST(LightCurve, HoldsTheEndsThatAreToBeHeld) {
  const NurbsCurve dense = test::denseCurve(randomLine(3), false);
  for (const LightHold hold : {LightHold::Tangent, LightHold::Curvature}) {
    LightOptions options = within(0.1);
    options.start = options.end = hold;
    const auto light = makeLight(dense, false, options, {});
    ASSERT_TRUE(light);
    ASSERT_NE(light->report.kind, LightKind::Dense);
    EXPECT_LT(light->report.points, 20);
    for (const bool atEnd : {false, true}) {
      const auto a = light->curve.derivatives(atEnd ? light->curve.end() : light->curve.start(), 2);
      const auto b = dense.derivatives(atEnd ? dense.end() : dense.start(), 2);
      EXPECT_LT(std::abs(cross(a[1].normalized(), b[1].normalized())), 1e-9);
      if (hold != LightHold::Curvature) continue;
      EXPECT_NEAR(cross(a[1], a[2]) / std::pow(a[1].norm(), 3), cross(b[1], b[2]) / std::pow(b[1].norm(), 3), 1e-9);
    }
  }
}

TEST(LightCurve, IsTheSameCurveWhateverTheUnit) {
  const NurbsCurve dense = test::denseCurve(randomLine(5), false);
  const auto light = makeLight(dense, false, within(0.1), {});
  const double mm = 0.0846;
  LightOptions options = within(0.1 * mm);
  options.step = 0.5 * mm;
  const auto scaled = makeLight(dense.mapped(mm * Eigen::Matrix2d::Identity(), Vec2(3.0, -2.0)), false, options, {});
  ASSERT_TRUE(light && scaled);
  ASSERT_EQ(light->curve.controlPointCount(), scaled->curve.controlPointCount());
  for (int i = 0; i < light->curve.controlPointCount(); ++i) {
    const Vec2 expected = mm * light->curve.controlPoints()[i] + Vec2(3.0, -2.0);
    EXPECT_LT((scaled->curve.controlPoints()[i] - expected).norm(), 1e-3);
  }
}

TEST(LightCurve, LeavesACurveWithACornerAlone) {
  const NurbsCurve first = test::denseCurve(randomLine(1), false);
  const Vec2 end = first.point(first.end());
  const auto second = NurbsCurve::make(
      5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1},
      {end, end + Vec2(0, 20), end + Vec2(0, 40), end + Vec2(1, 60), end + Vec2(3, 80), end + Vec2(6, 100)});
  ASSERT_TRUE(second);
  const NurbsCurve both[] = {first, *second};
  const auto joined = joinAtCorners(both, 1e-9);
  ASSERT_TRUE(joined);
  const auto light = makeLight(*joined, false, within(0.2), {});
  ASSERT_TRUE(light);
  EXPECT_EQ(light->report.kind, LightKind::Dense);
  EXPECT_EQ(light->curve, *joined);
}

TEST(LightCurve, HearsACancelAndRefusesNoTolerance) {
  const NurbsCurve dense = test::denseCurve(randomLine(2), false);
  RunContext context;
  context.cancel.cancel();
  const auto none = makeLight(dense, false, within(0.05), context);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::Cancelled);
  const auto wrong = makeLight(dense, false, within(0.0), {});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::BadParameter);
}

}  // namespace
}  // namespace batten
