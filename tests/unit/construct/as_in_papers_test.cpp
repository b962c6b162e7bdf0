// SPDX-License-Identifier: GPL-3.0-or-later
// The choices with which the papers' own constructions are repeated.
#include <gtest/gtest.h>

#include <numbers>

#include "core/construct/construct.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature_jump.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

using std::numbers::pi;

ConstructPiece quarter(int count) { return test::pieceOf(test::ellipsePoint, 0.2, 1.4, count, false); }

/// Groups: their midpoints lie inside the ends of the line.
ConstructPiece grouped(int count) {
  ConstructPiece piece = quarter(2);
  piece.stations.clear();
  for (int i = 0; i < count; ++i) {
    const double t = 0.2 + 1.2 * (i + 0.5) / count;
    const Vec2 d = Vec2(-300.0 * std::sin(t), 150.0 * std::cos(t)).normalized();
    const Vec2 p = test::ellipsePoint(t);
    piece.stations.push_back({p, d, p - d, p + d});
  }
  return piece;
}

Result<ConstructedPiece> made(const ConstructPiece& piece, const ConstructParams& params) {
  ConstructContour contour;
  contour.pieces = {piece};
  auto all = construct(contour, params, {});
  if (!all) return fail(all.error());
  return std::move(all->front());
}

ConstructParams nurbs(ConstructEnds ends) {
  ConstructParams params;
  params.method = ConstructMethod::Nurbs;
  params.magnitudeAsInPaper = false;
  params.maxDeviationPx = 0.0;
  params.ends = ends;
  return params;
}

TEST(AsInPapers, ManyMidpointsGiveFourControlPointsMore) {
  for (const int m : {2, 3, 4, 7, 8}) {
    const ConstructPiece piece = grouped(m);
    const auto curve = made(piece, nurbs(ConstructEnds::Stations));
    ASSERT_TRUE(curve) << curve.error().message;
    EXPECT_EQ(curve->curve.controlPointCount(), m + 4) << m;
    EXPECT_LT((curve->curve.point(curve->curve.start()) - piece.stations.front().point).norm(), 1.0) << m;
    EXPECT_LT((curve->curve.point(curve->curve.end()) - piece.stations.back().point).norm(), 1.0) << m;
    const auto whole = made(piece, nurbs(ConstructEnds::Line));
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->curve.point(whole->curve.start()), piece.points.front().at) << "by default to the line's ends";
  }
}

TEST(AsInPapers, ThePathBeforeEqualisingHasJumpsAtItsJoints) {
  ConstructParams params;
  params.method = ConstructMethod::Bezier;
  params.lowPass = 0.0;
  params.maxDeviationPx = 0.0;
  const auto equal = made(quarter(7), params);
  params.equaliseJoints = false;
  const auto before = made(quarter(7), params);
  ASSERT_TRUE(equal && before);
  EXPECT_LT(largestCurvatureJump(equal->curve, false), 1e-6);
  EXPECT_GT(largestCurvatureJump(before->curve, false), 1e-3);
  EXPECT_LT(deviation(before->curve, equal->curve).max, 2.0);
}

TEST(AsInPapers, UniformKnotsEndShortOfTheLine) {
  ConstructParams params;
  params.method = ConstructMethod::ControlPolygon;
  params.removalStepPx = 20.0;
  const auto held = made(quarter(7), params);
  params.knots = SharpKnots::Uniform;
  const auto free = made(quarter(7), params);
  ASSERT_TRUE(held && free);
  const Vec2 end = quarter(7).points.front().at;
  EXPECT_LT((held->curve.point(held->curve.start()) - end).norm(), 1e-9);
  EXPECT_GT((free->curve.point(free->curve.start()) - end).norm(), 1.0);
  EXPECT_FALSE(free->report.note.empty());
}

ConstructParams growing(bool asInPaper) {
  ConstructParams params;
  params.method = ConstructMethod::Typical;
  params.typical = TypicalMode::Growing;
  params.growingAsInPaper = asInPaper;
  return params;
}

int typicalCount(const ConstructReport& report) {
  return static_cast<int>(
      std::count_if(report.segments.begin(), report.segments.end(), [](const SegmentNote& n) { return n.typical; }));
}

TEST(GrownChains, FindTypicalCurvesOnClosedLines) {
  const auto egg = [](double t) { return Vec2(300.0 * std::cos(t) * (1.0 + 0.15 * std::cos(t)), 200.0 * std::sin(t)); };
  for (const auto& shape : {test::PlaneCurve(test::ellipsePoint), test::PlaneCurve(egg)}) {
    for (const bool asInPaper : {false, true}) {
      const auto grown = made(test::pieceOf(shape, 0.0, 2.0 * pi, 24, true), growing(asInPaper));
      ASSERT_TRUE(grown) << grown.error().message;
      EXPECT_GT(typicalCount(grown->report), 0) << asInPaper << " " << grown->report.note;
      if (!asInPaper) {
        EXPECT_GT(typicalShare(grown->report.segments), 0.5) << grown->report.note;
      }
    }
  }
}

TEST(GrownChains, AsInThePaperNothingTakesTheirPlace) {
  const auto wave = [](double t) { return Vec2(400.0 * t, 60.0 * std::sin(3.0 * t)); };
  for (const double to : {1.0, 2.0, 4.0}) {
    const auto grown = made(test::pieceOf(wave, 0.1, to, 30, false), growing(true));
    ASSERT_TRUE(grown);
    EXPECT_FALSE(grown->report.segments.empty()) << "no Bezier path instead";
  }
}

TEST(TypicalSegments, TwoPlacesMeanOneSegmentBetweenThem) {
  for (const TypicalMode mode : {TypicalMode::Chain, TypicalMode::Growing}) {
    ConstructPiece piece = test::pieceOf(test::ellipsePoint, 0.1, 1.5, 30, false);
    const Vec2 first = test::ellipsePoint(0.35), second = test::ellipsePoint(1.1);
    piece.breakpoints = {first, second};
    ConstructParams params = growing(false);
    params.typical = mode;
    const auto chain = made(piece, params);
    ASSERT_TRUE(chain);
    ASSERT_FALSE(chain->report.segments.empty()) << chain->report.note;
    int from = -1, to = -1;
    for (int i = 0; i < std::ssize(chain->report.segments); ++i) {
      const Vec2& start = chain->report.segments[i].start;
      if ((start - first).norm() < 3.0) from = i;
      if ((start - second).norm() < 3.0) to = i;
    }
    std::string starts;
    for (const SegmentNote& one : chain->report.segments)
      starts += " (" + std::to_string(one.start.x()) + ", " + std::to_string(one.start.y()) + ")";
    ASSERT_GE(from, 0) << static_cast<int>(mode) << starts;
    EXPECT_EQ(to, from + 1) << static_cast<int>(mode) << starts;
  }
}

}  // namespace
}  // namespace batten
