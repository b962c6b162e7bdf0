// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/corner_rounding.h"

#include <gtest/gtest.h>

#include "core/curve/knot_operations.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/segment_points.h"

namespace batten {
namespace {

NurbsCurve line(const Vec2& a, const Vec2& b, int degree) {
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, (b - a).norm());
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
    pieces.pieces[0].points = {{0, 0}, {100, 0}};
    pieces.pieces[0].endIsCorner = true;
    pieces.pieces[1].points = {{100, 0}, {100, 80}};
    pieces.pieces[1].startIsCorner = true;
    Corner corner;
    corner.positionPx = {100, 0};
    pieces.corners.push_back(corner);
    recipe.cornerMarks.push_back({Vec2(100, 0), 10.0});
    for (int i = 0; i < 2; ++i) {
      TracedCurve& curve = set.curves.emplace_back();
      curve.piece = i;
      const auto& p = pieces.pieces[i].points;
      curve.sketched = curve.faired = line(p[0], p[1], degree);
    }
  }
};

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

TEST(RoundCorners, TheFiguresAreThoseOfTheRoundedCurve) {
  Angle angle(5);
  const PageFrame frame{200, 100, 0.5};
  for (std::size_t k = 0; k < 2; ++k) {
    Piece& piece = angle.pieces.pieces[k];
    const Vec2 a = piece.points[0], b = piece.points[1];
    piece.points.clear();
    for (int i = 0; i < 100; ++i) piece.points.push_back(a + (b - a) * i / 100.0);
    piece.points.push_back(b);
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
            "Left as sketched. A corner could not be rounded: its sides do not meet ahead. It stays sharp.");
  EXPECT_EQ(angle.set.curves[1].fairing.note,
            "A corner could not be rounded: its sides do not meet ahead. It stays sharp.");
}

TEST(RecipeFile, KeepsRoundedCornersAndSegmentPoints) {
  Recipe recipe;
  recipe.cornerMarks = {{Vec2(1, 2)}, {Vec2(3, 4), 2.5}};
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
    const Vec2 a = piece.points[0], b = piece.points[1];
    piece.points.clear();
    for (int i = 0; i <= 100; ++i) piece.points.push_back(a + (b - a) * i / 100.0);
  }
  angle.recipe.segmentPoints = {{Vec2(50, 3)}, {Vec2(97, 40)}, {Vec2(0, 70)}};
  EXPECT_EQ(assignSegmentPoints(angle.pieces, angle.recipe), (std::vector<std::vector<std::size_t>>{{0}, {1}}));
}

}  // namespace
}  // namespace batten
