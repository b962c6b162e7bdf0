// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/construct/fair/fair_fit.h"
#include "core/construct/fair/fair_join.h"
#include "core/construct/fair/sharp_features.h"
#include "core/construct/fair/smooth_sections.h"
#include "core/curve/closest_point.h"
#include "tests/unit/construct/fair_shapes.h"

namespace batten {
namespace {

/// Points every px along a polygon, with white noise across.
std::vector<Vec2> alongPolygon(const std::vector<Vec2>& corners, bool closed, double sigma) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, sigma);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < corners.size(); ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    const Vec2 along = (b - a).normalized();
    for (double s = 0.0; s < (b - a).norm(); s += 1.0)
      points.push_back(a + s * along + normal(random) * leftNormal(along));
  }
  return points;
}

double farthest(const std::vector<Vec2>& points, const NurbsCurve& curve) {
  std::vector<Vec2> samples;
  for (int i = 0; i <= 2000; ++i) {
    samples.push_back(curve.point(curve.start() + (curve.end() - curve.start()) * i / 2000.0));
  }
  double worst = 0.0;
  for (const Vec2& p : points) {
    double best = 1e300;
    for (const Vec2& q : samples) best = std::min(best, (p - q).norm());
    worst = std::max(worst, best);
  }
  return worst;
}

double lengthOf(const NurbsCurve& curve) {
  double length = 0.0;
  Vec2 last = curve.point(curve.start());
  for (int i = 1; i <= 2000; ++i) {
    const Vec2 p = curve.point(curve.start() + (curve.end() - curve.start()) * i / 2000.0);
    length += (p - last).norm();
    last = p;
  }
  return length;
}

TEST(SharpFeatures, UnmarkedCornersStayOnTheirPoints) {
  const std::vector<Vec2> square{{0, 0}, {200, 0}, {200, 200}, {0, 200}};
  const std::vector<Vec2> zigzag{{0, 0}, {120, 30}, {20, 60}, {140, 95}, {60, 98}};
  for (const bool closed : {true, false}) {
    const auto points = alongPolygon(closed ? square : zigzag, closed, 0.1);
    const auto fit = test::fitOne(points, closed);
    ASSERT_TRUE(fit.has_value());
    const NurbsCurve& curve = fit->front().curve;
    EXPECT_LT(farthest(points, curve), 2.0) << closed;
    EXPECT_NEAR(lengthOf(curve) / static_cast<double>(points.size()), 1.0, 0.05) << closed;
    // A rounded corner has at least the extremum of its tip; the straight sides have none.
    EXPECT_GE(fit->front().report.extremaInSharpFeatures, closed ? 4 : 3);
    EXPECT_TRUE(std::none_of(fit->front().report.extrema.begin(), fit->front().report.extrema.end(),
                             [](const ExtremumNote& e) { return e.kept; }));
    EXPECT_NE(fit->front().report.note.find(closed ? "at 4 places" : "at 3 places"), std::string::npos)
        << fit->front().report.note;
  }
}

TEST(SharpFeatures, TheCurveIsSmoothAcrossItsJoints) {
  const auto fit = test::fitOne(alongPolygon({{0, 0}, {200, 0}, {200, 200}, {0, 200}}, true, 0.1), true);
  ASSERT_TRUE(fit.has_value());
  const NurbsCurve& curve = fit->front().curve;
  const auto breaks = curve.breaks();
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const double before = std::nextafter(breaks[i], breaks[i - 1]);
    const auto left = curve.derivatives(before, 2), right = curve.derivatives(breaks[i], 2);
    EXPECT_LT((left[0] - right[0]).norm(), 1e-8);
    EXPECT_LT((left[1] - right[1]).norm(), 1e-6);
    EXPECT_LT((left[2] - right[2]).norm(), 1e-5);
  }
  const auto start = curve.derivatives(curve.start(), 4), end = curve.derivatives(curve.end(), 4);
  for (std::size_t d = 0; d < 5; ++d) EXPECT_LT((start[d] - end[d]).norm(), 1e-6) << d;
}

TEST(SharpFeatures, FairLinesHaveNoSharpTurns) {
  for (const double radius : {15.0, 40.0, 300.0}) {
    const auto truth = test::curveOfCurvature(5.0 * radius, [&](double) { return 1.0 / radius; });
    ConstructPiece piece;
    piece.points = piecePoints(test::noisyPoints(truth, 0.127, 3));
    EXPECT_TRUE(sharpFeatures(piece, false, {}).empty()) << radius;
  }
}

TEST(SharpFeatures, TightCurvesMeetTheirNeighbours) {
  const CurveEnd before{Vec2(0, 0), Vec2(1, 0), Vec2(0, 0.01)}, after{Vec2(8, 8), Vec2(0, 1.1), Vec2(0.02, 0)};
  const std::vector<Vec2> points{{1, 0},   {2, 0},   {3, 0},   {4, 0}, {5, 0.2},
                                 {6, 0.6}, {7, 1.5}, {7.6, 3}, {8, 5}, {8, 7}};
  for (const Vec2& place : {Vec2(0, 0), Vec2(3000, -2000)}) {
    std::vector<Vec2> moved;
    for (const Vec2& p : points) moved.push_back(p + place);
    const CurveEnd a{before[0] + place, before[1], before[2]}, b{after[0] + place, after[1], after[2]};
    const auto curve = cornerFill(moved, a, b);
    ASSERT_TRUE(curve.has_value());
    const CurveEnd first = startOf(*curve), last = endOf(*curve);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_LT((first[d] - a[d]).norm(), 1e-9) << d;
      EXPECT_LT((last[d] - b[d]).norm(), 1e-9) << d;
    }
    EXPECT_LT(farthest(moved, *curve), 1.5);
  }
}

/// The points of a piece moved aside about one place, so that a fit of the others leaves them there.
std::vector<Vec2> bulged(std::vector<Vec2> points, const std::vector<Vec2>& normals, int at) {
  for (int i = at - 12; i <= at + 12; ++i) {
    points[i] += 3.0 * std::exp(-0.02 * (i - at) * (i - at)) * normals[i];
  }
  return points;
}

TEST(SharpFeatures, WhatIsLeftInTheLastRoundIsOnlyCutOut) {
  constexpr int kCount = 1256, kAt = 300;
  std::vector<Vec2> circle, out;
  for (int i = 0; i < kCount; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kCount;
    out.emplace_back(std::cos(t), std::sin(t));
    circle.push_back(200.0 * out.back() + 20.0 * Vec2(std::cos(2.0 * t), 0.0));
  }
  for (const bool closed : {true, false}) {
    for (const int at : closed ? std::vector{kAt, 20} : std::vector{kAt}) {
      const auto fit = test::fitOne(circle, closed);
      ASSERT_TRUE(fit.has_value());
      ConstructPiece piece;
      piece.points = piecePoints(bulged(circle, out, at));
      piece.closed = closed;
      SmoothSections parts(piece, false, {});
      ASSERT_EQ(parts.stretches().size(), 1U);
      EXPECT_TRUE(parts.check({fit->front()}, true));
      const auto whole = std::move(parts).joined({});
      ASSERT_TRUE(whole.has_value()) << whole.error().message;
      EXPECT_EQ(whole->report.why, Termination::Converged) << closed;
      EXPECT_NE(whole->report.note.find("at 1 place"), std::string::npos) << whole->report.note;
      EXPECT_LT(farthest(positionsOf(piece.points), whole->curve), 1.5) << closed;
      EXPECT_LE(whole->curve.controlPointCount(), fit->front().curve.controlPointCount() + 40);
      double worst = 0.0;  // the rest is the curve of before
      for (int i = 0; i < kCount; i += 5) {
        if (std::abs(i - at) < 40 || std::abs(i - at) > kCount - 40) continue;
        const Vec2 on = closestPoint(fit->front().curve, circle[i]).point;
        worst = std::max(worst, closestPoint(whole->curve, on).distance);
      }
      EXPECT_LT(worst, 1e-6) << closed << ' ' << at;
      const double length = whole->curve.end() - whole->curve.start();
      for (const NoiseNote& note : whole->report.noise) EXPECT_LE(note.s, length + 1e-9);
      EXPECT_TRUE(std::ranges::is_sorted(whole->report.noise, {}, &NoiseNote::s));
    }
  }
}

// Grain excuses a fit that leaves its points towards its end; a sharp turn that follows does not begin beside the line.
TEST(SharpFeatures, AFitIsCutWhereItIsOnItsPointsBesideASharpTurn) {
  constexpr double kGrainPx = 0.7, kOffPx = 2.0;
  ConstructPiece piece;
  piece.points = piecePoints(alongPolygon({{0, 0}, {150, 0}, {130, 110}}, false, 0.0));
  piece.grain.sigmaPx = kGrainPx;
  SmoothSections parts(piece, true, {});
  const std::vector<ConstructPiece> stretches = parts.stretches();
  ASSERT_EQ(stretches.size(), 2U);
  std::vector<ConstructedPiece> fits(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec2 from = stretches[i].points.front().at, to = stretches[i].points.back().at;
    std::vector<Vec2> controls;
    for (int k = 0; k <= 5; ++k) controls.push_back(from + (to - from) * (k / 5.0));
    if (i == 0) controls.back() += Vec2(0.0, kOffPx);
    std::vector<double> knots(6, 0.0);
    knots.insert(knots.end(), 6, (to - from).norm());
    fits[i].curve = NurbsCurve::make(5, std::move(knots), std::move(controls)).value();
  }
  EXPECT_FALSE(parts.check(fits, true));
  const auto whole = std::move(parts).joined({});
  ASSERT_TRUE(whole.has_value()) << whole.error().message;
  EXPECT_LT(farthest(positionsOf(piece.points), whole->curve), 0.6 * kOffPx);
}

// Scattered points, or a pen gone wild: thousands of sharp places would each be fitted around, again and again.
TEST(SharpFeatures, ALineOfMoreThanAThousandIsNotTakenApart) {
  std::vector<Vec2> zigzag;
  for (int i = 0; i < 1100; ++i) zigzag.emplace_back(20.0 * i, i % 2 == 0 ? 0.0 : 60.0);
  const auto points = alongPolygon(zigzag, false, 0.0);
  const auto fit = test::fitOne(points, false);
  ASSERT_TRUE(fit.has_value());
  const std::string& note = fit->front().report.note;
  EXPECT_NE(note.find("(1098, at most 1000)"), std::string::npos) << note;
  EXPECT_LT(deviation(fit->front().curve, points, true).max, 1.5);
}

TEST(SharpFeatures, ADrawnLineOfMoreThanTenThousandIsRefused) {
  std::vector<Vec2> zigzag;
  for (int i = 0; i < 10'100; ++i) zigzag.emplace_back(20.0 * i, i % 2 == 0 ? 0.0 : 30.0);
  ConstructContour drawn;
  drawn.pixelMm = 1.0;
  drawn.pieces.resize(1);
  drawn.pieces[0].points = piecePoints(alongPolygon(zigzag, false, 0.0));
  drawn.pieces[0].isDrawn = true;
  const auto fit = fairFit(drawn, {}, {});
  ASSERT_FALSE(fit.has_value());
  EXPECT_EQ(fit.error().code, ErrorCode::NoCurve);
  EXPECT_NE(fit.error().message.find("at 10098 places, at most 10000"), std::string::npos) << fit.error().message;
}

}  // namespace
}  // namespace batten
