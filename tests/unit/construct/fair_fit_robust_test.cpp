// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "core/construct/fair/fair_fit.h"
#include "tests/unit/construct/fair_shapes.h"

namespace batten {
namespace {

std::vector<Vec2> ellipsePoints(double a, double b, int count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 0.127);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * std::numbers::pi * i / count;
    const Vec2 out = Vec2(std::cos(t) / a, std::sin(t) / b).normalized();
    points.push_back(Vec2(a * std::cos(t), b * std::sin(t)) + normal(random) * out);
  }
  return points;
}

TEST(FairFit, ClosedCurvesMeetWithAllDerivatives) {
  struct Case {
    double a, b;
    int count;
  };
  for (const Case& shape : {Case{300, 300, 1885}, Case{300, 180, 1532}, Case{20, 20, 126}}) {
    const auto fit = test::fitOne(ellipsePoints(shape.a, shape.b, shape.count, 3), true);
    ASSERT_TRUE(fit.has_value());
    const NurbsCurve& c = fit->front().curve;
    const auto start = c.derivatives(c.start(), 4), end = c.derivatives(c.end(), 4);
    // A derivative of order d is a d-th difference of control points over powers of the knot spacing.
    const double spacing = c.breaks()[1] - c.breaks()[0];
    for (std::size_t d = 0; d < 5; ++d) {
      const double scale = shape.a * std::pow(10.0 / spacing, static_cast<double>(d));
      EXPECT_LT((start[d] - end[d]).norm(), 1e-12 * scale) << shape.b << " derivative " << d;
    }
    EXPECT_EQ(fit->front().report.isCircle, shape.a == shape.b);
    EXPECT_EQ(test::extremaOf(c, true).size(), shape.a == shape.b ? 0U : 4U);
    if (shape.a != shape.b) continue;
    for (const double kappa : test::profileOf(c).kappa) EXPECT_NEAR(kappa * shape.b, 1.0, 5e-3);
  }
}

TEST(FairFit, EndsExactlyAtCorners) {
  const auto truth = test::curveOfCurvature(300.0, [](double s) { return 0.002 + 1e-5 * s; });
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    ConstructContour contour;
    contour.pixelMm = 0.2645833;
    contour.pieces.resize(1);
    ConstructPiece& piece = contour.pieces[0];
    piece.points = piecePoints(test::noisyPoints(truth, 0.127, seed));
    piece.points.front().at =
        truth.points.front() + 0.3 * truth.normals.front();  // a corner is never quite on the line
    piece.points.back().at = truth.points.back() - 0.2 * truth.normals.back();
    for (PiecePoint& p : piece.points) p.at = p.at * contour.pixelMm + Vec2(100.0, 50.0);
    piece.startIsCorner = piece.endIsCorner = true;
    const auto fit = test::fitInMillimetres(contour);
    ASSERT_TRUE(fit.has_value());
    const NurbsCurve& c = fit->front().curve;
    EXPECT_EQ(c.point(c.start()), piece.points.front().at);
    EXPECT_EQ(c.point(c.end()), piece.points.back().at);
    EXPECT_EQ(test::extremaOf(c, false).size(), 0U) << seed;
  }
}

TEST(FairFit, TinyPiecesDoNotSpoilAContour) {
  ConstructContour contour;
  const auto truth = test::curveOfCurvature(200.0, [](double) { return 0.01; });
  contour.pieces.resize(5);
  contour.pieces[0].points = piecePoints(test::noisyPoints(truth, 0.127, 1));
  contour.pieces[1].points = {{Vec2(0.0, 0.0)}, {Vec2(3.0, 4.0)}};
  contour.pieces[1].startIsCorner = contour.pieces[1].endIsCorner = true;
  contour.pieces[2].points =
      piecePoints(std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.1}, {1.0, 0.1}, {2.0, 0.0}, {3.0, 0.2}, {4.0, 0.1}});
  for (std::size_t i = 0; i < 480; i += 16) contour.pieces[3].points.push_back({truth.points[i]});
  contour.pieces[3].endIsCorner = true;
  for (int i = 0; i < 20; ++i)
    contour.pieces[4].points.push_back({Vec2(3.0 * std::cos(i * 0.314), 3.0 * std::sin(i * 0.314))});
  contour.pieces[4].closed = true;
  const auto fit = fairFit(contour, {}, {});
  ASSERT_TRUE(fit.has_value()) << fit.error().message;
  ASSERT_EQ(fit->size(), 5U);
  EXPECT_EQ((*fit)[0].report.why, Termination::Converged);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_EQ((*fit)[i].report.why, Termination::Degenerate) << i;
    EXPECT_FALSE((*fit)[i].report.note.empty());
    EXPECT_EQ((*fit)[i].curve.degree(), 5);
  }
  const NurbsCurve& line = (*fit)[1].curve;
  for (int i = 0; i <= 10; ++i) {
    const double u = line.start() + (line.end() - line.start()) * i / 10.0;
    EXPECT_LT((line.point(u) - Vec2(0.3, 0.4) * i).norm(), 1e-12);
  }
  EXPECT_LT(test::rmsFrom(truth, (*fit)[3].curve), 0.02);
  EXPECT_EQ((*fit)[3].curve.point((*fit)[3].curve.end()), contour.pieces[3].points.back().at);
  const NurbsCurve& loop = (*fit)[4].curve;
  for (int i = 0; i <= 10; ++i) {
    EXPECT_NEAR(loop.point(loop.start() + (loop.end() - loop.start()) * i / 10.0).norm(), 3.0, 0.3);
  }
}

// The foot of a small j or t: a low degree would round it.
TEST(FairFit, AShortHookKeepsItsShape) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 0.1);
  for (const double radius : {4.0, 5.0, 6.0}) {
    for (const double turn : {1.4, 2.0, 2.6}) {
      constexpr int kStem = 12;  // px, a point a pixel
      std::vector<Vec2> truth;
      for (int i = -kStem; i < 0; ++i) truth.emplace_back(0.0, i);
      const int count = static_cast<int>(std::lround(turn * radius));
      for (int i = 0; i <= count; ++i) {
        const double angle = turn * i / count;
        truth.emplace_back(radius * (1.0 - std::cos(angle)), radius * std::sin(angle));
      }
      std::vector<Vec2> points = truth;
      for (Vec2& p : points) p += Vec2(normal(random), normal(random));
      const auto fit = test::fitOne(points, false);
      ASSERT_TRUE(fit.has_value());
      const NurbsCurve& c = fit->front().curve;
      double farthest = 0.0;
      for (const Vec2& p : truth) {
        double nearest = 1e9;
        for (int k = 0; k <= 200; ++k)
          nearest = std::min(nearest, (c.point(c.start() + k / 200.0 * (c.end() - c.start())) - p).norm());
        farthest = std::max(farthest, nearest);
      }
      EXPECT_LT(farthest, 0.75) << radius << " " << turn;
    }
  }
}

TEST(FairFit, StandsStraysRepeatedPointsAndPerfectData) {
  const auto truth = test::curveOfCurvature(500.0, [](double s) { return 0.006 * std::sin(s / 80.0); });
  auto points = test::noisyPoints(truth, 0.127, 4);
  points[100] += Vec2(30.0, 80.0);
  points[200] += Vec2(2.0, 3.0);
  points[201] += Vec2(2.0, 3.0);
  points.insert(points.begin() + 50, points[50]);
  auto fit = test::fitOne(points, false);
  ASSERT_TRUE(fit.has_value());
  EXPECT_LT(test::rmsFrom(truth, fit->front().curve), 0.08);
  EXPECT_EQ(test::extremaOf(fit->front().curve, false).size(), 2U);
  fit = test::fitOne(test::noisyPoints(truth, 0.0, 1), false);
  ASSERT_TRUE(fit.has_value());
  EXPECT_LT(test::rmsFrom(truth, fit->front().curve), 0.01);
}

TEST(FairFit, SameCurveWithAnyNumberOfThreadsAndAnyScale) {
  const auto truth = test::curveOfCurvature(300.0, [](double s) { return 0.004 * std::cos(s / 60.0); });
  ConstructContour contour, scaled;
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    contour.pieces.emplace_back();
    contour.pieces.back().points = piecePoints(test::noisyPoints(truth, 0.127, seed));
    scaled.pieces.push_back(contour.pieces.back());
    for (PiecePoint& p : scaled.pieces.back().points) p.at *= 0.125;
  }
  scaled.pixelMm = 0.125;
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  const auto a = fairFit(contour, {}, one), b = fairFit(contour, {}, four), c = test::fitInMillimetres(scaled, {}, one);
  ASSERT_TRUE(a && b && c);
  for (std::size_t i = 0; i < a->size(); ++i) {
    EXPECT_TRUE((*a)[i].curve == (*b)[i].curve);
    // To the last bit: the fit is made in px, and a power of two changes no digit.
    const auto points = (*a)[i].curve.controlPoints(), scaledPoints = (*c)[i].curve.controlPoints();
    ASSERT_EQ(points.size(), scaledPoints.size());
    for (std::size_t k = 0; k < points.size(); ++k) EXPECT_EQ(Vec2(0.125 * points[k]), scaledPoints[k]);
    const auto &notes = (*a)[i].report.extrema, &scaledNotes = (*c)[i].report.extrema;
    ASSERT_EQ(notes.size(), scaledNotes.size());
    for (std::size_t k = 0; k < notes.size(); ++k) {
      EXPECT_EQ(0.125 * notes[k].s, scaledNotes[k].s);
      EXPECT_EQ(8.0 * notes[k].kappa, scaledNotes[k].kappa);
      EXPECT_EQ(Vec2(0.125 * notes[k].point), scaledNotes[k].point);
    }
  }
}

TEST(FairFit, RefusesNonsenseWithAMessage) {
  ConstructContour contour;
  contour.pixelMm = 0.0;
  EXPECT_FALSE(test::fitInMillimetres(contour).has_value());
  contour.pixelMm = 1.0;
  EXPECT_TRUE(fairFit(contour, {}, {}).value().empty());
  contour.pieces.resize(1);
  contour.pieces[0].points = {{Vec2(1.0, 1.0)}};
  const auto fit = fairFit(contour, {}, {});
  ASSERT_FALSE(fit.has_value());
  EXPECT_EQ(fit.error().code, ErrorCode::Numerical);
}

}  // namespace
}  // namespace batten
