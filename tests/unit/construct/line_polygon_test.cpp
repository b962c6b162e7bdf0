// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/construct/polygon/control_polygon.h"
#include "core/curve/closest_point.h"
#include "core/curve/knot_operations.h"
#include "tests/support/known_answers.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

/// A letter K of 85 points as in 004: straight legs between eleven sharp points, at the ordinal numbers of the paper.
struct PaperK {
  std::vector<Vec2> points;
  std::vector<int> sharp;
};
PaperK paperK() {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "04_knots.json");
  const std::vector<Vec2> corners = {{0, 0},     {0, 100},  {25, 100}, {25, 60}, {60, 100}, {95, 100}, {50, 52},
                                     {100, -50}, {65, -50}, {25, 35},  {25, 0},  {12, -3},  {0, 0}};
  PaperK k;
  for (const auto& p : answer.at("sharp_1based")) k.sharp.push_back(p.get<int>() - 1);
  std::vector<int> at = {0};
  at.insert(at.end(), k.sharp.begin(), k.sharp.end());
  at.push_back(84);
  for (std::size_t leg = 0; leg + 1 < at.size(); ++leg) {
    const int count = at[leg + 1] - at[leg];
    for (int i = 0; i < count; ++i) k.points.push_back(corners[leg] + (corners[leg + 1] - corners[leg]) * i / count);
  }
  k.points.push_back(corners.back());
  return k;
}

/// The line cut at its sharp points, as the pipeline hands it over.
ConstructContour contourOf(const PaperK& k) {
  ConstructContour contour;
  std::size_t from = 0;
  for (std::size_t i = 0; i <= k.sharp.size(); ++i) {
    const bool last = i == k.sharp.size();
    const std::size_t to = last ? k.points.size() - 1 : k.sharp[i];
    ConstructPiece& piece = contour.pieces.emplace_back();
    piece.points = piecePoints(std::span(k.points).subspan(from, to - from + 1));
    piece.startIsCorner = i > 0;
    piece.endIsCorner = !last;
    from = to;
  }
  return contour;
}

ConstructParams polygonParams(int degree, double step = 0.0) {
  ConstructParams params;
  params.method = ConstructMethod::ControlPolygon;
  params.degree = degree;
  params.removalStepPx = step;
  return params;
}

TEST(LinePolygon, TheLetterKGivesTheKnotsOfThePaper) {
  const PaperK k = paperK();
  ASSERT_EQ(k.points.size(), 85u);
  const LinePolygon line = linePolygon(contourOf(k), polygonParams(2));
  EXPECT_EQ(line.points, k.points);
  EXPECT_EQ(line.sharp, k.sharp);
  EXPECT_EQ(line.before, 85);
  EXPECT_FALSE(line.closed);
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "04_knots.json");
  const auto made = polygonCurve(line, 2, SharpKnots::Order);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->knots, answer.at("order3").get<std::vector<double>>());
  EXPECT_FALSE(made->warning.empty()) << "the paper's multiplicity breaks the curve, and says so";
  const auto cornered = polygonCurve(line, 2, SharpKnots::Degree);
  ASSERT_TRUE(cornered);
  EXPECT_EQ(cornered->knots, answer.at("order3_C0_recommended").get<std::vector<double>>());
  EXPECT_EQ(cornered->added, 0);
}

TEST(LinePolygon, EveryDegreeKeepsTheElevenCornersOfTheK) {
  const PaperK k = paperK();
  for (int degree = 2; degree <= 5; ++degree) {
    const LinePolygon line = linePolygon(contourOf(k), polygonParams(degree));
    const auto made = polygonCurve(line, degree, SharpKnots::Degree).value();
    const auto uniform = polygonCurve(line, degree, SharpKnots::Uniform).value();
    for (const int s : k.sharp) {
      EXPECT_LT(closestPoint(made.curve, k.points[s]).distance, 1e-9) << degree;
    }
    // Between sharp points the legs are straight, so the curve lies on the polygon; the uniform one cuts the corners.
    double farthest = 0.0;
    for (const Vec2& p : k.points) farthest = std::max(farthest, closestPoint(uniform.curve, p).distance);
    EXPECT_LT(deviation(made.curve, k.points, true).max, 1e-9);
    EXPECT_GT(farthest, 1.0);
    EXPECT_EQ(std::ssize(uniform.knots), std::ssize(k.points) + degree + 1);
  }
}

TEST(LinePolygon, ThePiecesJoinedAreTheWholeCurve) {
  const PaperK k = paperK();
  for (int degree = 2; degree <= 5; ++degree) {
    for (const double step : {0.0, 11.0}) {
      const ConstructParams params = polygonParams(degree, step);
      const ConstructContour contour = contourOf(k);
      const auto pieces = construct(contour, params, {}).value();
      std::vector<NurbsCurve> curves;
      for (const ConstructedPiece& piece : pieces) curves.push_back(piece.curve);
      const NurbsCurve joined = joinAtCorners(curves, 1e-9).value();
      const auto whole = polygonCurve(linePolygon(contour, params), degree, SharpKnots::Degree).value();
      ASSERT_EQ(joined.controlPointCount(), whole.curve.controlPointCount());
      for (int i = 0; i < joined.controlPointCount(); ++i) {
        EXPECT_LT((joined.controlPoints()[i] - whole.curve.controlPoints()[i]).norm(), 1e-9);
      }
    }
  }
}

TEST(LinePolygon, MultiplicityOfTheOrderBreaksTheCurveWhereThePaperDoes) {
  const PaperK k = paperK();
  ConstructParams params = polygonParams(2);
  params.knots = SharpKnots::Order;
  const auto pieces = construct(contourOf(k), params, {}).value();
  const auto whole = polygonCurve(linePolygon(contourOf(k), params), 2, SharpKnots::Order).value();
  int repeated = 0;
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    const Vec2& corner = k.points[k.sharp[i]];
    const Vec2& before = k.points[k.sharp[i] - 1];
    EXPECT_LT((pieces[i].curve.point(pieces[i].curve.end()) - before).norm(), 1e-12);
    EXPECT_LT((pieces[i + 1].curve.point(pieces[i + 1].curve.start()) - corner).norm(), 1e-12);
    EXPECT_FALSE(pieces[i].report.note.empty());
  }
  for (std::size_t i = 0; i + 2 < whole.knots.size(); ++i) {
    repeated += i > 2 && i + 3 < whole.knots.size() - 2 && whole.knots[i] == whole.knots[i + 2] ? 1 : 0;
  }
  EXPECT_EQ(repeated, 11);
}

TEST(LinePolygon, RemovalCountsAndKeepsCorners) {
  const PaperK k = paperK();
  const LinePolygon all = linePolygon(contourOf(k), polygonParams(3, 0.0));
  const LinePolygon some = linePolygon(contourOf(k), polygonParams(3, 40.0));
  ConstructParams accurate = polygonParams(3);
  accurate.removal = PointRemoval::Tolerance;
  accurate.removalTolerancePx = 0.01;
  const LinePolygon few = linePolygon(contourOf(k), accurate);
  EXPECT_EQ(all.points.size(), 85u);
  EXPECT_EQ(some.before, 85);
  EXPECT_LT(some.points.size(), 60u);
  EXPECT_EQ(few.points.size(), 13u) << "straight legs need their ends alone";
  for (const LinePolygon* line : {&some, &few}) {
    ASSERT_EQ(line->sharp.size(), 11u);
    for (std::size_t i = 0; i < 11; ++i) {
      EXPECT_EQ(line->points[line->sharp[i]], k.points[k.sharp[i]]);
    }
  }
  // So few points between close corners: what is missing for the degree is added, and counted.
  const auto made = polygonCurve(few, 3, SharpKnots::Degree).value();
  EXPECT_EQ(made.added, 12 * 2);
  EXPECT_EQ(made.points.size(), 13u + 24u);
  EXPECT_LT(deviation(made.curve, k.points, true).max, 1e-9);
}

TEST(LinePolygon, AClosedLineStartsAtItsFirstCornerAndIsPeriodicWithout) {
  ConstructContour square;
  const std::vector<Vec2> corners = {{0, 0}, {60, 0}, {60, 60}, {0, 60}};
  for (std::size_t i = 0; i < 4; ++i) {
    ConstructPiece& piece = square.pieces.emplace_back();
    for (int s = 0; s <= 6; ++s) piece.points.push_back({corners[i] + (corners[(i + 1) % 4] - corners[i]) * s / 6.0});
    piece.startIsCorner = piece.endIsCorner = true;
  }
  const LinePolygon line = linePolygon(square, polygonParams(3));
  EXPECT_TRUE(line.closed);
  EXPECT_EQ(line.points.size(), 24u);
  EXPECT_EQ(line.before, 24);
  EXPECT_EQ(line.sharp, (std::vector<int>{0, 6, 12, 18}));
  const auto made = polygonCurve(line, 3, SharpKnots::Degree).value();
  EXPECT_EQ(made.curve.point(made.curve.start()), Vec2(0, 0));
  EXPECT_LT((made.curve.point(made.curve.end()) - Vec2(0, 0)).norm(), 1e-12);
  EXPECT_EQ(made.sharp, (std::vector<int>{6, 12, 18}));
  const auto uniform = polygonCurve(line, 3, SharpKnots::Uniform).value();
  // A cubic B-spline leaves a right angle of unit steps by sqrt(2)/6 of a step (closed form of its basis 1/6, 4/6,
  // 1/6).
  EXPECT_NEAR(closestPoint(uniform.curve, {60, 60}).distance, 10.0 * std::sqrt(2.0) / 6.0, 1e-6);
  EXPECT_LT((uniform.curve.point(uniform.curve.start()) - uniform.curve.point(uniform.curve.end())).norm(), 1e-9);
}

TEST(ConstructControlPolygon, APenStrokeUsesOnlyItsDrawnPoints) {
  ConstructPiece piece;
  for (int i = 0; i <= 40; ++i) piece.points.push_back({Vec2(i, i < 20 ? 0.0 : 0.3 * (i - 20))});
  const std::array drawn{0, 13, 20, 31, 40};
  piece.isDrawn = true;
  for (PiecePoint& p : piece.points) p.refined = false;
  for (const int i : drawn) piece.points[i].refined = true;
  const auto made = constructControlPolygon(piece, polygonParams(2), {}).value();
  EXPECT_EQ(made.report.polygon.value().before, 5);
  EXPECT_EQ(made.report.polygon.value().after, 5);
  ASSERT_EQ(made.curve.controlPointCount(), 5);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(made.curve.controlPoints()[i], piece.points[drawn[i]].at);
  }
}

}  // namespace
}  // namespace batten
