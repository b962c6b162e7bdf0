// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/polygon/control_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/curve/closest_point.h"
#include "tests/support/known_answers.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

std::vector<int> zeroBased(const nlohmann::json& list) {
  std::vector<int> result;
  for (const auto& i : list) result.push_back(i.get<int>() - 1);
  return result;
}

TEST(SharpKnotVector, MatchesThePaperAndTheKnownAnswer) {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "04_knots.json");
  const auto sharp = zeroBased(answer.at("sharp_1based"));
  const int count = answer.at("n_control");
  for (const int order : {3, 4, 5}) {
    const auto name = "order" + std::to_string(order);
    EXPECT_EQ(sharpKnotVector(order, count, sharp, SharpKnots::Order), answer.at(name).get<std::vector<double>>());
    if (order < 5) {
      EXPECT_EQ(sharpKnotVector(order, count, sharp, SharpKnots::Degree),
                answer.at(name + "_C0_recommended").get<std::vector<double>>());
    }
  }
  // The printed listing of order 4 is too long by one: misprinted.
  EXPECT_EQ(answer.at("order4_paper_listing_as_printed").size(), 90u);
}

TEST(ControlPolygonCurve, SmallCaseOfTheKnownAnswer) {
  const auto small = test::knownAnswer(BATTEN_TEST_DATA, "04_knots.json").at("small_case");
  const auto points = test::toPoints(small.at("control"));
  const std::vector<int> sharp = {small.at("sharp_1based").get<int>() - 1};
  for (const bool paper : {true, false}) {
    const auto kind = paper ? SharpKnots::Order : SharpKnots::Degree;
    EXPECT_EQ(sharpKnotVector(4, 9, sharp, kind),
              small.at(paper ? "order4_paper" : "order4_C0").get<std::vector<double>>());
    const auto made = controlPolygonCurve(points, sharp, 3, kind);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->warning.empty(), !paper);
    const auto limits = test::toPoints(small.at(paper ? "left_right_limits_paper" : "left_right_limits_C0"));
    const auto breaks = made->curve.breaks();
    // The corner knot is the one where the direction turns by a right angle.
    const double knot = made->curve.knots()[paper ? 4 : 5];
    EXPECT_LT((made->curve.point(knot - 1e-9 * breaks.back()) - limits[0]).norm(), 1e-6);
    EXPECT_LT((made->curve.point(knot) - limits[1]).norm(), 1e-9);
  }
}

TEST(ControlPolygonCurve, PassesThroughSharpPointsHoweverCloseTheyAre) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> where(0.0, 100.0);
  for (int trial = 0; trial < 200; ++trial) {
    const int degree = 2 + trial % 4;
    std::vector<Vec2> points;
    std::vector<int> sharp;
    const int count = 2 + static_cast<int>(random() % 25);
    for (int i = 0; i < count; ++i) {
      points.emplace_back(where(random), where(random));
      if (i > 0 && i + 1 < count && random() % 3 == 0) sharp.push_back(i);
    }
    const auto made = controlPolygonCurve(points, sharp, degree, SharpKnots::Degree);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->curve.degree(), degree);
    if (made->added == 1) {
      EXPECT_EQ(made->warning, "Between close sharp points 1 control point was doubled.");
    }
    EXPECT_EQ(made->curve.point(made->curve.start()), points.front());
    EXPECT_LT((made->curve.point(made->curve.end()) - points.back()).norm(), 1e-12);
    for (const int s : sharp) {
      EXPECT_LT(closestPoint(made->curve, points[s]).distance, 1e-9);
    }
    // No break: the curve is nowhere two points at once.
    const auto& c = made->curve;
    for (const double u : c.breaks()) {
      EXPECT_LT((c.point(u) - c.point(u - 1e-10 * c.end())).norm(), 1e-4);
    }
  }
}

TEST(ControlPolygonCurve, UniformStaysAwayFromTheCorner) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 10; ++i) points.emplace_back(i < 6 ? i : 5, i < 6 ? 0 : i - 5);
  const std::vector<int> sharp = {5};
  const auto uniform = controlPolygonCurve(points, sharp, 3, SharpKnots::Uniform).value();
  const auto cornered = controlPolygonCurve(points, sharp, 3, SharpKnots::Degree).value();
  EXPECT_NEAR(closestPoint(uniform.curve, {5, 0}).distance, std::sqrt(2.0) / 6.0, 1e-6);
  EXPECT_LT(closestPoint(cornered.curve, {5, 0}).distance, 1e-9);
  EXPECT_GT((uniform.curve.point(uniform.curve.start()) - points.front()).norm(), 0.5);
  EXPECT_FALSE(controlPolygonCurve(std::span(points).first(1), {}, 3, SharpKnots::Degree));
}

TEST(ControlPolygonCurve, IsTheBezierCurveOfItsDoubledPoints) {
  // Three points between two corners: a Bezier curve whose middle point counts as often as it is taken.
  const std::vector<Vec2> points = {{0, 0}, {4, 5}, {11, 3}};
  for (int degree = 2; degree <= 5; ++degree) {
    const auto made = controlPolygonCurve(points, {}, degree, SharpKnots::Degree).value();
    EXPECT_EQ(made.added, degree - 2);
    for (const double f : {0.0, 0.2, 0.5, 0.8, 1.0}) {
      const double first = std::pow(1 - f, degree), last = std::pow(f, degree);
      const Vec2 expected = first * points[0] + (1 - first - last) * points[1] + last * points[2];
      EXPECT_LT((made.curve.point(f * made.curve.end()) - expected).norm(), 1e-12);
    }
  }
}

TEST(ConstructControlPolygon, AllDegreesOpenAndClosed) {
  for (int degree = 2; degree <= 5; ++degree) {
    ConstructParams params;
    params.degree = degree;
    const auto open = test::pieceOf(test::ellipsePoint, 0.1, 2.0, 10, false);
    const auto made = constructControlPolygon(open, params, {}).value();
    EXPECT_EQ(made.curve.degree(), degree);
    EXPECT_LT(deviation(made.curve, positionsOf(open.points), true).max, 0.5);
    EXPECT_EQ(made.curve.point(made.curve.start()), open.points.front().at);
    const auto closed = test::pieceOf(test::ellipsePoint, 0.0, 2 * std::numbers::pi, 10, true);
    const auto around = constructControlPolygon(closed, params, {}).value();
    EXPECT_LT(deviation(around.curve, positionsOf(closed.points), true).max, 0.5);
    const auto a = around.curve.derivatives(around.curve.start(), degree - 1);
    const auto b = around.curve.derivatives(around.curve.end(), degree - 1);
    for (int d = 0; d < degree; ++d) EXPECT_LT((a[d] - b[d]).norm(), 1e-9);
  }
}

TEST(WithEnoughPoints, DoublesWhatIsMissingBetweenCloseCorners) {
  // Corners at 2 and 4 with one point between them; a quartic needs five from corner to corner.
  const std::vector<Vec2> points = {{0, 0}, {10, 4}, {20, 0}, {25, 8}, {30, 0}, {40, 5}, {50, 0}, {60, 4}, {70, 0}};
  const std::vector<int> sharp = {2, 4};
  const SharpPolygon made = withEnoughPoints(points, sharp, 4);
  EXPECT_EQ(made.added, 2 + 2);
  ASSERT_EQ(made.sharp, (std::vector<int>{4, 8}));
  EXPECT_EQ(std::count(made.points.begin(), made.points.end(), points[1]), 3);
  EXPECT_EQ(std::count(made.points.begin(), made.points.end(), points[3]), 3);
  for (const std::size_t corner : {0u, 2u, 4u, 8u}) {
    EXPECT_EQ(std::count(made.points.begin(), made.points.end(), points[corner]), 1) << "corners are never doubled";
  }
  const auto curve = controlPolygonCurve(points, sharp, 4, SharpKnots::Degree).value();
  for (const int s : sharp) {
    EXPECT_LT(closestPoint(curve.curve, points[s]).distance, 1e-9);
  }
  // Drawn harder: nearer to the doubled point than the three points of a parabola would bring it.
  EXPECT_LT(closestPoint(curve.curve, points[3]).distance, 0.5 * (8.0 - 4.0));
  // Two of two inner points, then nothing between the corners.
  EXPECT_EQ(withEnoughPoints(std::vector<Vec2>{{0, 0}, {1, 1}, {2, 1}, {3, 0}}, {}, 5).points,
            (std::vector<Vec2>{{0, 0}, {1, 1}, {1, 1}, {2, 1}, {2, 1}, {3, 0}}));
  EXPECT_EQ(withEnoughPoints(std::vector<Vec2>{{0, 0}, {3, 0}}, {}, 3).points,
            (std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
}

}  // namespace
}  // namespace batten
