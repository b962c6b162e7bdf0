// SPDX-License-Identifier: GPL-3.0-or-later
// "Maximum deviation" on lines that make it hard: turned ends, gaps between the points, sharp turns, noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/construct/construct.h"
#include "core/construct/stations/adaptive_stations.h"
#include "core/contour/segment/regression_segments.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

using std::numbers::pi;

constexpr std::array kMethods = {ConstructMethod::Nurbs, ConstructMethod::Bezier};

/// A piece through points, in px, with the stations that the program sets.
ConstructPiece pieceThrough(const std::vector<Vec2>& points, bool closed,
                            const std::vector<std::uint8_t>& refined = {}) {
  PieceSet set;
  Piece& px = set.pieces.emplace_back();
  px.points = piecePoints(points);
  for (std::size_t i = 0; i < refined.size(); ++i) px.points[i].refined = refined[i] != 0;
  px.closed = closed;
  ConstructPiece piece{px};
  piece.stations = regressionSegments(set, {}, {}).value().pieces[0].stations;
  return piece;
}

Result<std::vector<ConstructedPiece>> constructed(const ConstructPiece& piece, ConstructMethod method,
                                                  double maxDeviation) {
  ConstructParams params;
  params.method = method;
  params.maxDeviationPx = maxDeviation;
  ConstructContour contour;
  contour.pieces = {piece};
  return construct(contour, params, {});
}

TEST(StayWithin, KeepsAFreeEndThatTurns) {
  for (const double radius : {6.0, 7.0, 8.0}) {
    std::vector<Vec2> points;
    for (int i = 0; i < static_cast<int>(pi * radius); ++i) {
      const double turn = pi - i / radius;
      points.emplace_back(-radius * std::sin(turn), radius * (1.0 - std::cos(turn)));
    }
    for (int i = 0; i <= 400; ++i) points.emplace_back(i, 0.0);
    for (const bool backwards : {false, true}) {
      if (backwards) std::reverse(points.begin(), points.end());
      const auto piece = pieceThrough(points, false);
      for (const auto method : kMethods) {
        for (const double maxDeviation : {0.5, 2.0}) {
          const NurbsCurve curve = constructed(piece, method, maxDeviation).value()[0].curve;
          EXPECT_LT((curve.point(curve.start()) - points.front()).norm(), 1.5 * maxDeviation) << radius;
          EXPECT_LT((curve.point(curve.end()) - points.back()).norm(), 1.5 * maxDeviation) << radius;
        }
      }
    }
  }
}

/// Strokes around a circle that neither begin nor end quite on it, with gaps of up to 17 px between them.
std::vector<Vec2> gappedLoop(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double band = 8.0 + 40.0 * unit(random), radius = 100.0 + 80.0 * unit(random);
  const int strokes = 2 + static_cast<int>(4.0 * unit(random));
  double angle = 2.0 * pi * unit(random);
  std::vector<Vec2> points;
  for (int k = 0; k < strokes; ++k, angle += 2.0 * pi / strokes) {
    const double span = 2.0 * pi / strokes - (2.0 + 15.0 * unit(random)) / radius;
    const double from = radius + 0.4 * band * (unit(random) - 0.5), to = radius + 0.4 * band * (unit(random) - 0.5);
    const int count = static_cast<int>(span * radius);
    for (int i = 0; i <= count; ++i) {
      const double share = static_cast<double>(i) / count, r = from + (to - from) * share;
      points.emplace_back(r * Vec2(std::cos(angle + span * share), std::sin(angle + span * share)));
    }
  }
  return points;
}

TEST(StayWithin, KeepsALoopWithAGap) {
  for (const double where : {0.0, 0.4, 1.6}) {
    std::vector<Vec2> points, truth;
    for (int i = 0; i < 1200; ++i) {
      const double t = where + 2.0 * pi * i / 1200.0;
      truth.emplace_back(200.0 * std::cos(t), 70.0 * std::sin(t));
      if ((truth.back() - truth.front()).norm() > 7.5) points.push_back(truth.back());
    }
    double length = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) length += (truth[(i + 1) % truth.size()] - truth[i]).norm();
    const auto piece = pieceThrough(points, true);
    for (const auto method : kMethods) {
      const NurbsCurve curve = constructed(piece, method, 1.0).value()[0].curve;
      EXPECT_LT(deviation(curve, points, true).max, 1.5) << where;
      EXPECT_NEAR(ArcLength(curve).total(), length, 0.01 * length);
    }
  }
}

TEST(StayWithin, GoesNotAstrayInGaps) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 40; ++trial) {
    const auto piece = pieceThrough(gappedLoop(random), true);
    for (const auto method : kMethods) {
      const auto given = constructed(piece, method, 0.0), closer = constructed(piece, method, 2.0);
      ASSERT_TRUE(given && closer) << trial << (closer ? "" : closer.error().message);
      const NurbsCurve &a = given->front().curve, &b = closer->front().curve;
      EXPECT_LT(deviation(b, positionsOf(piece.points), true).max,
                std::max(4.0, deviation(a, positionsOf(piece.points), true).max + 2.5))
          << trial;
      EXPECT_LT(ArcLength(b).total(), 1.1 * ArcLength(a).total()) << trial;
    }
  }
}

/// Stretches of constant curvature, some of them very sharp.
std::vector<Vec2> sharpLine(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int count = 100 + static_cast<int>(700.0 * unit(random));
  double angle = 6.0 * unit(random), kappa = 0.0;
  Vec2 at = Vec2::Zero();
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    if (unit(random) < 0.03) kappa = 2.0 * (unit(random) - 0.5) * std::pow(10.0, -3.0 + 2.7 * unit(random));
    points.push_back(at);
    for (int k = 0; k < 10; ++k) {
      angle += 0.1 * kappa;
      at += 0.1 * Vec2(std::cos(angle), std::sin(angle));
    }
  }
  return points;
}

TEST(StayWithin, IsKeptOrTold) {
  std::mt19937 random(11);
  int told = 0, worse = 0;
  constexpr int kLines = 40;
  for (int trial = 0; trial < kLines; ++trial) {
    const auto piece = pieceThrough(sharpLine(random), false);
    for (const auto method : kMethods) {
      const auto given = constructed(piece, method, 0.0).value(), closer = constructed(piece, method, 2.0).value();
      const double before = deviation(given[0].curve, positionsOf(piece.points), true).max;
      const double after = deviation(closer[0].curve, positionsOf(piece.points), true).max;
      EXPECT_TRUE(given[0].report.note.empty());
      told += closer[0].report.note.empty() ? 0 : 1;
      worse += after > before + 1.0 ? 1 : 0;
      // The limit is for means over 5 px.
      if (closer[0].report.note.empty()) {
        EXPECT_LT(after, 5.0) << trial;
      }
    }
  }
  EXPECT_LT(told, kLines / 4);
  EXPECT_LE(worse, 1);
}

TEST(StayWithin, NoiseAddsNothing) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 0.3);
  std::vector<Vec2> points;
  for (int i = 0; i <= 1600; ++i) points.emplace_back(i, 150.0 * std::sin(i / 400.0) + noise(random));
  const auto piece = pieceThrough(points, false);
  for (const double maxDeviation : {0.1, 0.2, 0.3}) {
    for (const auto method : kMethods) {
      EXPECT_LE(constructed(piece, method, maxDeviation).value()[0].report.stationsAdded, 8) << maxDeviation;
    }
  }
}

TEST(StayWithin, GoesByThePointsThatAreBetterKnown) {
  // Every third point is known to the pixel only, and off.
  std::vector<Vec2> points, truth;
  std::vector<std::uint8_t> refined;
  for (int i = 0; i <= 400; ++i) {
    const double turn = std::clamp((i - 180.0) / 12.0, 0.0, pi);
    const Vec2 along(i < 180 ? i : 180.0 - std::max(0.0, i - 180.0 - 12.0 * pi), 0.0),
        normal(std::sin(turn), -std::cos(turn));
    truth.emplace_back(along + Vec2(0.0, 12.0) + 12.0 * normal);
    refined.push_back(i % 3 != 0);
    points.emplace_back(truth.back() + (refined.back() ? 0.0 : 1.0) * normal);
  }
  const auto weighted = pieceThrough(points, false, refined);
  auto alike = weighted;
  for (PiecePoint& p : alike.points) p.refined = true;
  for (const auto method : kMethods) {
    const auto a = constructed(weighted, method, 0.4).value(), b = constructed(alike, method, 0.4).value();
    EXPECT_GT(a[0].report.stationsAdded, 2);
    EXPECT_LT(deviation(a[0].curve, truth, true).rms, 0.9 * deviation(b[0].curve, truth, true).rms);
  }
}

}  // namespace
}  // namespace batten
