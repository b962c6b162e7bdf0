// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fit_start.h"

#include <gtest/gtest.h>

#include <random>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

/// Points and stations beside the ellipse by noise of the given size [px = mm here].
ConstructPiece noisyEllipse(double from, double to, int stations, bool closed, double noise) {
  ConstructPiece piece = test::pieceOf(test::ellipsePoint, from, to, stations, closed);
  std::mt19937 random(7);
  std::normal_distribution<double> scatter(0.0, noise);
  const auto moved = [&](const Vec2& p) { return Vec2(p.x() + scatter(random), p.y() + scatter(random)); };
  for (PiecePoint& p : piece.points) p.at = moved(p.at);
  for (Station& s : piece.stations) {
    s.point = moved(s.point);
    const double turn = scatter(random) / 30.0;
    s.direction = Vec2(s.direction + turn * leftNormal(s.direction)).normalized();
  }
  return piece;
}

double besideEllipse(const Vec2& p) {
  const double level = std::hypot(p.x() / 300.0, p.y() / 150.0) - 1.0;
  const Vec2 slope(p.x() / 90000.0, p.y() / 22500.0);
  return std::abs(level) / slope.norm();
}

int extremaOf(const NurbsCurve& curve, bool closed) {
  return static_cast<int>(curvatureExtrema(curve, 5e-3 / extent(curve), closed).size());
}

ConstructParams fromFit(ConstructMethod method) {
  ConstructParams params;
  params.method = method;
  params.start = ConstructStart::Fit;
  return params;
}

TEST(FitStart, FreesTheStationsOfTheirNoise) {
  ConstructContour contour;
  contour.pieces.push_back(noisyEllipse(0.0, 2.0 * std::numbers::pi, 40, true, 0.2));
  contour.pieces.push_back(noisyEllipse(0.1, 1.4, 12, false, 0.2));
  const auto fitted = onFairFit(contour, {}, {});
  ASSERT_TRUE(fitted) << fitted.error().message;
  for (std::size_t i = 0; i < 2; ++i) {
    double before = 0.0, after = 0.0;
    const auto& given = contour.pieces[i].stations;
    const auto& moved = fitted->pieces[i].stations;
    ASSERT_EQ(moved.size(), given.size());
    for (std::size_t k = 0; k < given.size(); ++k) {
      before += besideEllipse(given[k].point);
      after += besideEllipse(moved[k].point);
      EXPECT_GT(moved[k].direction.dot(given[k].direction), 0.99) << i << " " << k;
      EXPECT_LT((moved[k].point - given[k].point).norm(), 1.0) << i << " " << k;
    }
    EXPECT_LT(after, 0.4 * before) << i;
    for (const PiecePoint& p : fitted->pieces[i].points) EXPECT_LT(besideEllipse(p.at), 0.25);
  }
}

TEST(FitStart, SparesTheNurbsTheWavesOfTheNoise) {
  ConstructContour contour;
  contour.pieces.push_back(noisyEllipse(0.0, 2.0 * std::numbers::pi, 40, true, 0.2));
  for (std::size_t k = 0; k < 40; ++k) contour.pieces[0].stations[k].along = static_cast<double>(k) / 40.0;
  ConstructParams params = fromFit(ConstructMethod::Nurbs);
  const auto fit = construct(contour, params, {});
  params.start = ConstructStart::Line;
  const auto line = construct(contour, params, {});
  contour.pieces[0] = test::pieceOf(test::ellipsePoint, 0.0, 2.0 * std::numbers::pi, 40, true);
  const auto exact = construct(contour, params, {});
  ASSERT_TRUE(fit && line && exact);
  // Even spaced knots ripple a little at the ends of an ellipse, without any noise.
  const int own = extremaOf(exact->front().curve, true);
  EXPECT_LE(extremaOf(fit->front().curve, true), own);
  EXPECT_GT(extremaOf(line->front().curve, true), own + 6);
}

TEST(FitStart, LeavesWhatHasNoNoise) {
  ConstructContour contour;
  contour.pieces.push_back(test::pieceOf(test::ellipsePoint, 0.1, 1.45, 12, false));
  contour.pieces[0].startIsCorner = contour.pieces[0].endIsCorner = true;
  for (const ConstructMethod method :
       {ConstructMethod::Nurbs, ConstructMethod::Bezier, ConstructMethod::ControlPolygon}) {
    ConstructParams params = fromFit(method);
    const auto fit = construct(contour, params, {});
    params.start = ConstructStart::Line;
    const auto line = construct(contour, params, {});
    ASSERT_TRUE(fit && line);
    // Control polygons keep every eighth pixel: of other points when these lie elsewhere along the line.
    const double apart = method == ConstructMethod::ControlPolygon ? 0.2 : 0.01;
    EXPECT_LT(deviation(fit->front().curve, line->front().curve).max, apart) << static_cast<int>(method);
    const auto& curve = fit->front().curve;
    EXPECT_LT((curve.point(curve.start()) - contour.pieces[0].points.front().at).norm(), 1e-9);
    EXPECT_LT((curve.point(curve.end()) - contour.pieces[0].points.back().at).norm(), 1e-9);
  }
}

TEST(FitStart, StaysWithTheLineWhereThereIsNoFitAndSaysSo) {
  ConstructContour contour;
  contour.pieces.push_back(test::pieceOf(test::ellipsePoint, 0.1, 1.45, 12, false));
  contour.pieces[0].points.clear();
  ASSERT_FALSE(onFairFit(contour, {}, {}));
  const auto made = construct(contour, fromFit(ConstructMethod::Nurbs), {});
  ASSERT_TRUE(made);
  EXPECT_NE(made->front().report.note.find("the edge points"), std::string::npos);
}

TEST(FitStart, IsCancelled) {
  ConstructContour contour;
  contour.pieces.push_back(test::pieceOf(test::ellipsePoint, 0.1, 1.45, 12, false));
  RunContext context;
  context.cancel.cancel();
  const auto made = construct(contour, fromFit(ConstructMethod::Bezier), context);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace batten
