// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/stations/adaptive_stations.h"

#include <gtest/gtest.h>

#include "core/construct/construct.h"
#include "core/contour/segment/regression_segments.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature_jump.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

using std::numbers::pi;

/// Two legs of 230 px, 24 px apart, and the half circle between them: s is the arc length.
Vec2 hairpin(double s) {
  constexpr double kLeg = 230.0, kRadius = 12.0;
  if (s < kLeg) return {s, 0.0};
  const double turn = (s - kLeg) / kRadius;
  if (turn < pi) return {kLeg + kRadius * std::sin(turn), kRadius * (1.0 - std::cos(turn))};
  return {kLeg - (s - kLeg - pi * kRadius), 2.0 * kRadius};
}
constexpr double kHairpinLength = 460.0 + 12.0 * pi;

/// The piece with its stations as the program sets them.
ConstructPiece measured(const test::PlaneCurve& curve, double from, double to, int points, bool closed, double mm) {
  PieceSet set;
  Piece& px = set.pieces.emplace_back();
  px.closed = closed;
  for (int i = 0; i < points + (closed ? 0 : 1); ++i) px.points.push_back({curve(from + (to - from) * i / points)});
  ConstructPiece piece;
  piece.closed = closed;
  piece.stations = regressionSegments(set, {}, {}).value().pieces[0].stations;
  for (Station& s : piece.stations) {
    for (Vec2* p : {&s.point, &s.from, &s.to}) *p *= mm;
  }
  for (const PiecePoint& p : px.points) piece.points.push_back({mm * p.at});
  return piece;
}

double farthestPx(const ConstructPiece& piece, ConstructMethod method, double maxDeviationPx, double mm) {
  ConstructParams params;
  params.method = method;
  params.maxDeviationPx = maxDeviationPx;
  ConstructContour contour;
  contour.pieces = {piece};
  contour.pixelMm = mm;
  const auto made = construct(contour, params, {}).value();
  EXPECT_EQ(made[0].report.stationsAdded > 0, maxDeviationPx > 0.0);
  EXPECT_LT(largestCurvatureJump(made[0].curve, piece.closed), 1e-9);
  return deviation(made[0].curve, positionsOf(piece.points), true).max / mm;
}

TEST(AdaptiveStations, KeepACurveOnAHairpin) {
  for (const double mm : {1.0, 0.25}) {
    const auto piece = measured(hairpin, 0.0, kHairpinLength, 500, false, mm);
    for (const auto method : {ConstructMethod::Bezier, ConstructMethod::Nurbs}) {
      EXPECT_GT(farthestPx(piece, method, 0.0, mm), 3.0);
      EXPECT_LT(farthestPx(piece, method, 2.0, mm), 2.5);
      EXPECT_LT(farthestPx(piece, method, 0.5, mm), 1.0);
    }
  }
}

TEST(AdaptiveStations, KeepAClosedCurveOnSharpLobes) {
  const auto lobes = [](double t) {
    const double r = 150.0 + 90.0 * std::cos(5.0 * t);
    return Vec2(r * std::cos(t), r * std::sin(t));
  };
  const auto piece = measured(lobes, 0.0, 2.0 * pi, 2400, true, 0.3);
  for (const auto method : {ConstructMethod::Bezier, ConstructMethod::Nurbs}) {
    EXPECT_LT(farthestPx(piece, method, 0.5, 0.3), 1.0);
  }
}

TEST(AdaptiveStations, AddNoneWhereTheCurveIsNear) {
  const auto piece = measured(test::ellipsePoint, 0.0, 2.0 * pi, 1500, true, 1.0);
  for (const auto method : {ConstructMethod::Bezier, ConstructMethod::Nurbs}) {
    ConstructParams near, given;
    near.method = given.method = method;
    given.maxDeviationPx = 0.0;
    ConstructContour contour;
    contour.pieces = {piece};
    const auto a = construct(contour, near, {}).value(), b = construct(contour, given, {}).value();
    EXPECT_EQ(a[0].report.stationsAdded, 0);
    ASSERT_EQ(a[0].curve.controlPointCount(), b[0].curve.controlPointCount());
    for (int i = 0; i < a[0].curve.controlPointCount(); ++i) {
      EXPECT_EQ(a[0].curve.controlPoints()[i], b[0].curve.controlPoints()[i]);
    }
  }
}

TEST(AdaptiveStations, StandEvenlyAndInOrder) {
  const auto piece = measured(hairpin, 0.0, kHairpinLength, 500, false, 1.0);
  const auto chords = [](const StationSet& set) {
    std::vector<std::vector<Vec2>> lines;
    for (std::size_t i = 0; i + 1 < set.stations.size(); ++i) {
      lines.push_back({set.stations[i].point, set.stations[i + 1].point});
    }
    return lines;
  };
  const auto set = adaptiveStations(piece, givenStations(piece.stations), 0.5, chords, {});
  ASSERT_EQ(std::ssize(set.stations), std::ssize(piece.stations) + set.added);
  EXPECT_GT(set.added, 4);
  double last = -1.0;
  for (std::size_t i = 0; i < set.stations.size(); ++i) {
    // Every station lies on the hairpin, in its direction and farther along it than the one before.
    double best = 1e9, at = 0.0;
    for (int k = 0; k <= 5000; ++k) {
      const double s = kHairpinLength * k / 5000.0;
      if (const double away = (hairpin(s) - set.stations[i].point).norm(); away < best) best = away, at = s;
    }
    EXPECT_LT(best, 2.0);
    EXPECT_GT(at, last);
    last = at;
    // The last one has no interval after it.
    if (i > 0 && i + 1 < set.stations.size()) {
      EXPECT_LE(std::abs(set.stations[i].halvings - set.stations[i - 1].halvings), 1);
    }
    EXPECT_GT(set.stations[i].share, 0.0);
    EXPECT_LE(set.stations[i].share, 1.0);
  }
}

TEST(AdaptiveStations, LeaveWhatHasNoPointsToMeasure) {
  ConstructPiece bare;
  bare.stations = test::stationsOf(test::ellipsePoint, 0.0, 2.0 * pi, 12, true);
  bare.closed = true;
  const auto never = [](const StationSet&) { return std::vector<std::vector<Vec2>>{}; };
  EXPECT_EQ(adaptiveStations(bare, givenStations(bare.stations), 0.1, never, {}).added, 0);
  auto broken = measured(hairpin, 0.0, kHairpinLength, 500, false, 1.0);
  broken.points[7].at.x() = std::nan("");
  EXPECT_EQ(adaptiveStations(broken, givenStations(broken.stations), 0.1, never, {}).added, 0);
}

}  // namespace
}  // namespace batten
