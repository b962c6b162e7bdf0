// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/corner_rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/construct/typical/corner_blend.h"
#include "core/curve/bezier_quintics.h"
#include "core/curve/knot_operations.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/segment_points.h"

namespace batten {
namespace {

NurbsCurve line(const Vec2& a, const Vec2& b, int degree) {
  std::vector<double> knots(degree + 1, 0.0);
  knots.insert(knots.end(), degree + 1, (b - a).norm());
  std::vector<Vec2> points;
  for (int i = 0; i <= degree; ++i) points.push_back(a + (b - a) * i / degree);
  return NurbsCurve::make(degree, knots, points).value();
}

/// A right angle at (100, 0): along x, then up.
struct Angle {
  PieceSet pieces;
  FairedSet set;
  Recipe recipe;

  explicit Angle(int degree) {
    pieces.pieces.resize(2);
    pieces.pieces[0].points = {{Vec2(0, 0)}, {Vec2(100, 0)}};
    pieces.pieces[0].endIsCorner = true;
    pieces.pieces[1].points = {{Vec2(100, 0)}, {Vec2(100, 80)}};
    pieces.pieces[1].startIsCorner = true;
    Corner corner;
    corner.mark = 0;
    corner.positionPx = {100, 0};
    pieces.corners.push_back(corner);
    recipe.cornerMarks.push_back({Vec2(100, 0), 10.0});
    for (int i = 0; i < 2; ++i) {
      TracedCurve& curve = set.curves.emplace_back();
      curve.piece = i;
      const auto& p = pieces.pieces[i].points;
      curve.sketched = curve.faired = line(p[0].at, p[1].at, degree);
    }
  }
};

TEST(RoundCorners, StaySharpOnceTheRunIsCancelled) {
  Angle angle(5);
  const NurbsCurve before = angle.set.curves[0].faired;
  RunContext context;
  context.cancel.cancel();
  roundCorners(angle.set, angle.pieces, angle.recipe, {}, context);
  EXPECT_EQ(angle.set.curves[0].faired, before);
  roundCorners(angle.set, angle.pieces, angle.recipe, {});
  EXPECT_NE(angle.set.curves[0].faired, before);
}

TEST(RoundCorners, SayHowFarTheyMovedTheCurveAndLeaveTheFiguresOfFairingAlone) {
  Angle angle(5);
  for (TracedCurve& curve : angle.set.curves) curve.fairing.maxDeviationMm = 0.07;
  const NurbsCurve before = angle.set.curves[0].faired;
  roundCorners(angle.set, angle.pieces, angle.recipe, {});
  const TracedCurve& curve = angle.set.curves[0];
  EXPECT_EQ(curve.fairing.maxDeviationMm, 0.07);
  // The middle of the rounding is the point farthest from the corner's own place.
  double farthest = 0.0;
  for (int i = 0; i <= 2000; ++i) {
    const double u = curve.faired.start() + (curve.faired.end() - curve.faired.start()) * i / 2000.0;
    const Vec2 p = curve.faired.point(u);
    farthest = std::max(farthest, std::hypot(std::max(p.x() - 100.0, 0.0), p.y()));
  }
  double corner = 1e9;
  for (int i = 0; i <= 2000; ++i) {
    const double u = curve.faired.start() + (curve.faired.end() - curve.faired.start()) * i / 2000.0;
    corner = std::min(corner, (curve.faired.point(u) - Vec2(100, 0)).norm());
  }
  EXPECT_NEAR(curve.fairing.roundedMm, std::max(farthest, corner), 0.02);
}

TEST(RoundCorners, PutsTwoArcsBetweenTheShortenedNeighbours) {
  for (const int degree : {2, 3, 5}) {
    Angle angle(degree);
    roundCorners(angle.set, angle.pieces, angle.recipe, {});
    const NurbsCurve &a = angle.set.curves[0].faired, &b = angle.set.curves[1].faired;
    EXPECT_EQ(a.point(a.start()), Vec2(0, 0));
    EXPECT_LT((b.point(b.end()) - Vec2(100, 80)).norm(), 1e-9);
    const auto end = a.derivatives(a.end(), 2), start = b.derivatives(b.start(), 2);
    EXPECT_LT((end[0] - start[0]).norm(), 1e-9);
    EXPECT_NEAR(cross(end[1].normalized(), start[1].normalized()), 0.0, 1e-9);
    EXPECT_NEAR(curvature(a, a.end()).value(), curvature(b, b.start()).value(), 1e-6);
    // Up to 10 from the corner nothing has moved; the corner itself is cut off.
    EXPECT_NEAR(closestPoint(a, {89.0, 0.0}).distance, 0.0, 1e-9);
    EXPECT_NEAR(closestPoint(b, {100.0, 11.0}).distance, 0.0, 1e-9);
    EXPECT_GT((end[0] - Vec2(100, 0)).norm(), 1.0);
    EXPECT_LT((end[0] - Vec2(100, 0)).norm(), 4.2);
    EXPECT_TRUE(angle.set.curves[0].fairing.note.empty());
  }
}

TEST(RoundCorners, TakesAtMostPartOfItsNeighboursAndLeavesSharpOnesAlone) {
  Angle wide(5);
  wide.recipe.cornerMarks[0].roundMm = 400.0;
  roundCorners(wide.set, wide.pieces, wide.recipe, {});
  EXPECT_NEAR(closestPoint(wide.set.curves[0].faired, {50.0, 0.0}).distance, 0.0, 1e-9);
  Angle sharp(5);
  sharp.recipe.cornerMarks[0].roundMm = 0.0;
  roundCorners(sharp.set, sharp.pieces, sharp.recipe, {});
  EXPECT_EQ(sharp.set.curves[0].faired, sharp.set.curves[0].sketched);
}

/// A side that bends: an arc of a radius from a to b, bulging to its left where it is positive.
NurbsCurve arcBetween(const Vec2& a, const Vec2& b, double radius) {
  const Vec2 chord = b - a, middle = 0.5 * (a + b);
  const double half = 0.5 * chord.norm(), away = std::sqrt(radius * radius - half * half);
  const Vec2 centre = middle - std::copysign(away, radius) * leftNormal(chord.normalized());
  const double from = std::atan2((a - centre).y(), (a - centre).x()),
               turn = std::remainder(std::atan2((b - centre).y(), (b - centre).x()) - from, 2.0 * std::numbers::pi);
  // Quintic Hermite over a small angle: curvature right to a few digits, which is all that a side needs.
  const double r = std::abs(radius), side = turn > 0.0 ? 1.0 : -1.0;
  const auto joint = [&](double f) {
    const double angle = from + f * turn;
    return Joint{centre + r * Vec2(std::cos(angle), std::sin(angle)), side * Vec2(-std::sin(angle), std::cos(angle)),
                 side / r};
  };
  std::vector<Joint> joints;
  constexpr int kPieces = 8;
  for (int i = 0; i <= kPieces; ++i) joints.push_back(joint(static_cast<double>(i) / kPieces));
  return hermiteChain(joints, std::vector<double>(kPieces, r * std::abs(turn) / kPieces)).value();
}

/// The angle with sides that bend gently.
Angle bent(double radius1, double radius2, const CornerMark& mark) {
  Angle angle(5);
  angle.recipe.cornerMarks[0] = mark;
  angle.set.curves[0].sketched = angle.set.curves[0].faired = arcBetween({0, 0}, {100, 0}, radius1);
  angle.set.curves[1].sketched = angle.set.curves[1].faired = arcBetween({100, 0}, {100, 80}, radius2);
  roundCorners(angle.set, angle.pieces, angle.recipe, {});
  return angle;
}

double radiusOf(const Angle& angle) {
  constexpr int kPlaces = 2000;
  double largest = 0.0;
  for (const TracedCurve& one : angle.set.curves) {
    const auto breaks = one.faired.breaks();
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
      for (int i = 0; i < kPlaces; ++i) {
        const double u = breaks[k] + (breaks[k + 1] - breaks[k]) * (i + 0.5) / kPlaces;
        largest = std::max(largest, std::abs(curvature(one.faired, u).value()));
      }
  }
  return 1.0 / largest;
}

TEST(RoundCorners, ALargerSizeIsNeverSharper) {
  for (const RoundingJoint joint : {RoundingJoint::Tangent, RoundingJoint::Curvature, RoundingJoint::CurvatureSlope}) {
    for (const double radius : {150.0, -150.0, 400.0, -70.0}) {
      double before = 0.0;
      for (const double size : {1.0, 2.0, 4.0, 8.0, 16.0, 30.0}) {
        const Angle angle = bent(radius, -2.0 * radius, {Vec2(100, 0), size, RoundingSize::Distance, joint});
        const double now = radiusOf(angle);
        EXPECT_GT(now, 0.98 * before) << radius << " " << size << " " << static_cast<int>(joint);
        EXPECT_GT(now, 0.4 * std::min(size, 30.0))
            << radius << " " << size << " " << static_cast<int>(joint) << " " << angle.set.curves[0].fairing.note;
        before = now;
      }
    }
  }
}

TEST(RoundCorners, MeetTheRadiusThatIsAskedForOrSayWhy) {
  for (const double wanted : {1.0, 3.0, 10.0}) {
    const Angle angle = bent(200.0, -300.0, {Vec2(100, 0), wanted, RoundingSize::Radius});
    EXPECT_NEAR(radiusOf(angle), wanted, 0.01 * wanted);
    EXPECT_TRUE(angle.set.curves[0].fairing.note.empty());
  }
  const Angle large = bent(200.0, -300.0, {Vec2(100, 0), 300.0, RoundingSize::Radius});
  EXPECT_GT(radiusOf(large), 20.0);
  for (const TracedCurve& curve : large.set.curves)
    EXPECT_NE(curve.fairing.note.find("no larger radius fits"), std::string::npos) << "both sides say so";
}

TEST(RoundCorners, MeetTheirSidesAsSmoothlyAsAsked) {
  for (const RoundingJoint joint : {RoundingJoint::Curvature, RoundingJoint::CurvatureSlope}) {
    const Angle angle = bent(200.0, -300.0, {Vec2(100, 0), 10.0, RoundingSize::Distance, joint});
    const NurbsCurve& curve = angle.set.curves[0].faired;
    // The rounding begins at the last knot inside.
    const auto breaks = curve.breaks();
    const double u = breaks[breaks.size() - 2], h = 1e-10 * (curve.end() - curve.start());
    const BlendEnd left = blendEndAt(curve, u - h), right = blendEndAt(curve, u + h);
    EXPECT_LT((left.point - right.point).norm(), 1e-5);
    EXPECT_NEAR(left.kappa, right.kappa, 1e-5);
    EXPECT_NEAR(left.kappa, -1.0 / 200.0, 2e-4);
    if (joint == RoundingJoint::CurvatureSlope) {
      EXPECT_NEAR(left.kappaSlope, right.kappaSlope, 1e-4);
    }
  }
}

TEST(RoundCorners, TheFiguresAreThoseOfTheRoundedCurve) {
  Angle angle(5);
  const PageFrame frame{200, 100, 0.5};
  for (std::size_t k = 0; k < 2; ++k) {
    Piece& piece = angle.pieces.pieces[k];
    const Vec2 a = piece.points[0].at, b = piece.points[1].at;
    piece.points.clear();
    for (int i = 0; i < 100; ++i) piece.points.push_back({a + (b - a) * i / 100.0});
    piece.points.push_back({b});
    angle.set.curves[k].faired = line(frame.pointToModel(a), frame.pointToModel(b), 5);
  }
  roundCorners(angle.set, angle.pieces, angle.recipe, frame);
  for (const TracedCurve& curve : angle.set.curves) {
    const double cut = closestPoint(curve.faired, frame.pointToModel({100.0, 0.0})).distance;
    EXPECT_GT(cut, 1.0);
    EXPECT_NEAR(curve.fairedFigures.fromPoints.max, cut, 1e-6);
    EXPECT_EQ(curve.fairedFigures.fromPoints.count, 101);
    EXPECT_EQ(curve.sketchedFigures.fromPoints.count, 0) << "figures of the sketch are not those of the rounding";
  }
}

TEST(RoundCorners, SaysSoEvenWhereFairingHasSaidSomethingElse) {
  Angle angle(5);
  // Straight on: there is no corner to round.
  angle.set.curves[1].faired = line({100, 0}, {180, 0}, 5);
  angle.set.curves[0].fairing.note = "Left as sketched.";
  roundCorners(angle.set, angle.pieces, angle.recipe, {});
  EXPECT_EQ(angle.set.curves[0].fairing.note,
            "Left as sketched. A corner could not be rounded because its sides do not meet when "
            "extended.");
  EXPECT_EQ(angle.set.curves[1].fairing.note,
            "A corner could not be rounded because its sides do not meet when extended.");
}

TEST(RecipeFile, KeepsRoundedCornersAndSegmentPoints) {
  Recipe recipe;
  recipe.cornerMarks = {{Vec2(1, 2)},
                        {Vec2(3, 4), 2.5},
                        {Vec2(5, 6), 1.5, RoundingSize::Radius, RoundingJoint::CurvatureSlope},
                        {Vec2(7, 8), 0.5, RoundingSize::Distance, RoundingJoint::Tangent}};
  recipe.segmentPoints = {{Vec2(5.5, 6)}};
  const auto read = recipeFromJson(recipeToJson(recipe));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, recipe);
  recipe.cornerMarks[0].roundMm = -1.0;
  EXPECT_TRUE(validate(recipe));
}

TEST(SegmentPoints, BelongToTheNearestPieceWithinReach) {
  Angle angle(5);
  for (Piece& piece : angle.pieces.pieces) {
    const Vec2 a = piece.points[0].at, b = piece.points[1].at;
    piece.points.clear();
    for (int i = 0; i <= 100; ++i) piece.points.push_back({a + (b - a) * i / 100.0});
  }
  angle.recipe.segmentPoints = {{Vec2(50, 3)}, {Vec2(97, 40)}, {Vec2(0, 70)}};
  EXPECT_EQ(assignSegmentPoints(angle.pieces, angle.recipe), (std::vector<std::vector<std::size_t>>{{0}, {1}}));
}

}  // namespace
}  // namespace batten
