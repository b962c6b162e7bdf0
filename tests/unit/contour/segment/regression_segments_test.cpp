// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/segment/regression_segments.h"
#include "core/contour/segment/pca_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/known_answers.h"

namespace batten {
namespace {

TEST(Sturges, KnownAnswers) {
  const auto known = test::knownAnswer(BATTEN_TEST_DATA, "08_sturges.json");
  for (const auto& c : known.at("cases")) {
    const int n = c.at("N").get<int>(), k = c.at("k_floor").get<int>();
    EXPECT_EQ(sturgesGroups(n), k) << n;
    EXPECT_EQ(groupBoundaries(n, k), c.at("boundaries").get<std::vector<int>>()) << n;
  }
}

TEST(PcaLine, KnownAnswers) {
  const auto known = test::knownAnswer(BATTEN_TEST_DATA, "09_pca.json");
  const double tolerance = known.at("tolerance").get<double>();
  for (const auto& c : known.at("cases")) {
    const auto points = test::toPoints(c.at("points"));
    const PcaLine line = pcaLine(points);
    EXPECT_LE((line.centroid - test::toVec2(c.at("centroid"))).norm(), tolerance);
    EXPECT_LE((line.direction - test::toVec2(c.at("direction"))).norm(), tolerance);
    EXPECT_LE((line.from - test::toVec2(c.at("segment").at(0))).norm(), tolerance * 10);
    EXPECT_LE((line.to - test::toVec2(c.at("segment").at(1))).norm(), tolerance * 10);
    EXPECT_NEAR(line.eigenvalueMajor, c.at("eigenvalues").at(0).get<double>(), tolerance * 10);
    EXPECT_NEAR(line.eigenvalueMinor, c.at("eigenvalues").at(1).get<double>(), tolerance * 10);
    EXPECT_NEAR(line.residualRms, c.at("residual_rms").get<double>(), tolerance * 10);
  }
}

Piece arc(double radius, double angle, bool closed, double noise = 0.0) {
  Piece piece;
  piece.closed = closed;
  std::mt19937 random(5);
  std::normal_distribution<double> gauss(0.0, 1.0);
  const int n = static_cast<int>(radius * angle / 0.8);
  for (int i = 0; i < n; ++i) {
    const double a = angle * i / (closed ? n : n - 1);
    const double r = radius + (noise > 0.0 ? noise * gauss(random) : 0.0);
    piece.points.push_back({Vec2(300 + r * std::cos(a), 300 + r * std::sin(a))});
  }
  return piece;
}

PieceSegments segments(const Piece& piece, const SegmentParams& params) {
  PieceSet set;
  set.pieces.push_back(piece);
  const auto result = regressionSegments(set, params, {});
  EXPECT_TRUE(result.has_value());
  return result ? result->pieces.at(0) : PieceSegments{};
}

TEST(Stations, LieOnACircleAtEqualArcLength) {
  const double radius = 200.0;
  for (const bool closed : {false, true}) {
    const double angle = closed ? 2 * std::numbers::pi : 2.0;
    const PieceSegments result = segments(arc(radius, angle, closed), {});
    const int m = static_cast<int>(result.stations.size());
    EXPECT_EQ(m, static_cast<int>(std::lround(radius * angle / 40.0)) + (closed ? 0 : 1));
    for (int j = 0; j < m; ++j) {
      const Station& s = result.stations[j];
      const double a = angle * j / (closed ? m : m - 1);
      EXPECT_NEAR((s.point - Vec2(300, 300)).norm(), radius, 0.05);
      EXPECT_LE((s.point - Vec2(300 + radius * std::cos(a), 300 + radius * std::sin(a))).norm(), 0.1) << j;
      EXPECT_LE((s.direction - Vec2(-std::sin(a), std::cos(a))).norm(), 0.02) << j;
      EXPECT_NEAR(s.direction.norm(), 1.0, 1e-12);
      ASSERT_TRUE(s.along);
      EXPECT_NEAR(*s.along, static_cast<double>(j) / (closed ? m : m - 1), 1e-12);
    }
  }
}

TEST(Stations, EndsAtCornersAreExact) {
  Piece piece = arc(200.0, 1.5, false, 0.1);
  piece.startIsCorner = piece.endIsCorner = true;
  const PieceSegments result = segments(piece, {});
  EXPECT_EQ(result.stations.front().point, piece.points.front().at);
  EXPECT_EQ(result.stations.back().point, piece.points.back().at);
  EXPECT_GT(result.residualRmsPx, 0.05);
  EXPECT_LT(result.residualRmsPx, 0.15);
}

TEST(Stations, FewestAndFixedNumbers) {
  EXPECT_EQ(segments(arc(20.0, 1.0, false), {}).stations.size(), 4u);
  EXPECT_EQ(segments(arc(8.0, 2 * std::numbers::pi, true), {}).stations.size(), 6u);
  SegmentParams params;
  params.count = 23;
  EXPECT_EQ(segments(arc(200.0, 2.0, false), params).stations.size(), 23u);
  params.mode = SegmentMode::Count;
  EXPECT_EQ(segments(arc(200.0, 2.0, false), params).stations.size(), 23u);
  params.mode = SegmentMode::Sturges;
  EXPECT_EQ(segments(arc(200.0, 2.0, false), params).stations.size(), 9u);  // 500 points
}

TEST(Stations, TwoAndThreeMayBeAsked) {
  for (const SegmentMode mode : {SegmentMode::Stations, SegmentMode::Count}) {
    for (const int count : {2, 3}) {
      SegmentParams params;
      params.mode = mode;
      params.count = count;
      EXPECT_EQ(std::ssize(segments(arc(200.0, 2.0, false), params).stations), count);
    }
  }
}

TEST(Stations, AreNoMoreThanTheirPointsCanTellApart) {
  SegmentParams params;
  params.count = 500;
  const Piece dot = arc(6.0, 2.0 * std::numbers::pi, true);
  EXPECT_EQ(std::ssize(segments(dot, params).stations), std::ssize(dot.points) / 2);
  const Piece ring = arc(200.0, 2.0 * std::numbers::pi, true);
  EXPECT_EQ(segments(ring, params).stations.size(), 500u);
}

TEST(Sturges, CountsThePointsOfAPenStrokeThatWereDrawn) {
  SegmentParams params;
  params.mode = SegmentMode::Sturges;
  for (const auto& [drawn, groups] : {std::pair{119, 7}, {160, 8}}) {
    // Four points laid between two that were drawn.
    Piece piece = arc(400.0, 2.5, false);
    const int all = 5 * (drawn - 1) + 1;
    piece.points.clear();
    for (int i = 0; i < all; ++i) {
      const double a = 2.5 * i / (all - 1);
      piece.points.push_back({Vec2(300.0 + 400.0 * std::cos(a), 300.0 + 400.0 * std::sin(a)), i % 5 == 0});
    }
    piece.isPen = true;
    EXPECT_EQ(std::ssize(segments(piece, params).stations), groups) << drawn;
    piece.isPen = false;
    EXPECT_GT(std::ssize(segments(piece, params).stations), groups) << "on a scan all points count";
  }
}

TEST(Stations, AdaptiveTakesMoreWhereTheLineIsStricter) {
  SegmentParams loose, strict;
  loose.mode = strict.mode = SegmentMode::Adaptive;
  loose.tolerancePx = 2.0;
  strict.tolerancePx = 0.05;
  const Piece piece = arc(150.0, 2 * std::numbers::pi, true, 0.07);
  const auto few = segments(piece, loose).stations.size(), many = segments(piece, strict).stations.size();
  EXPECT_LT(few, many);
  EXPECT_LE(segments(arc(5000.0, 0.1, false), strict).stations.size(), 5u);  // almost straight
}

TEST(Stations, DegeneratePiecesStayFinite) {
  for (const auto mode : {SegmentMode::Stations, SegmentMode::Sturges, SegmentMode::Count, SegmentMode::Adaptive}) {
    SegmentParams params;
    params.mode = mode;
    for (const auto& points : {std::vector<Vec2>{},
                               {{1, 1}},
                               {{1, 1}, {4, 5}},
                               {{1, 1}, {2, 1}, {2, 2}},
                               std::vector<Vec2>(9, Vec2(2, 2))}) {
      for (const bool closed : {false, true}) {
        Piece piece;
        piece.points = piecePoints(points);
        for (PiecePoint& p : piece.points) p.refined = false;
        piece.closed = closed;
        const PieceSegments result = segments(piece, params);
        EXPECT_EQ(result.stations.empty(), points.empty());
        for (const Station& s : result.stations) {
          EXPECT_TRUE(s.point.allFinite() && s.direction.allFinite() && s.from.allFinite() && s.to.allFinite());
        }
      }
    }
  }
}

TEST(Stations, OfACancelledRunAreNone) {
  for (const SegmentMode mode :
       {SegmentMode::Stations, SegmentMode::Sturges, SegmentMode::Count, SegmentMode::Adaptive}) {
    for (const bool closed : {false, true}) {
      PieceSet set;
      set.pieces.push_back(arc(100.0, closed ? 2 * std::numbers::pi : 1.0, closed));
      SegmentParams params;
      params.mode = mode;
      RunContext context;
      context.cancel.cancel();
      const auto result = regressionSegments(set, params, context);
      ASSERT_FALSE(result.has_value());
      EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
    }
  }
}

TEST(Stations, BadParametersAreRefused) {
  SegmentParams params;
  params.count = 1;
  EXPECT_TRUE(validate(params).has_value());
  params = {};
  params.spacingPx = 0.0;
  EXPECT_FALSE(regressionSegments({}, params, {}).has_value());
}

}  // namespace
}  // namespace batten
