// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/piece_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

/// The part of a wavy line from x = `from` to `to`, `down` px below the first one, a point every px.
Piece wavy(double from, double to, double down = 0.0) {
  Piece piece;
  for (double x = from; x <= to; x += 1.0)
    piece.points.push_back({Vec2(x, 200.0 + down + 40.0 * std::sin(2.0 * std::numbers::pi * x / 400.0))});
  piece.lengthPx = to - from;
  return piece;
}

PieceSet numberedSet(std::vector<Piece> pieces) {
  PieceSet set;
  set.pieces = std::move(pieces);
  return set;
}
using Numbers = std::vector<int>;

TEST(PieceNumbers, CountFromOneWhereNothingIsKnown) {
  const PieceNumbers first = numberPieces(numberedSet({wavy(0, 300), wavy(0, 300, 50), wavy(0, 5, 90)}), {});
  EXPECT_EQ(first.ofPiece, (Numbers{1, 2, 3}));
  EXPECT_EQ(first.known.lastGiven, 3);
  EXPECT_TRUE(numberPieces({}, {}).ofPiece.empty());
}

TEST(PieceNumbers, StayWithTheirLinesInAnyOrderAndDirection) {
  const PieceNumbers first = numberPieces(numberedSet({wavy(0, 300), wavy(0, 300, 50), wavy(0, 300, 100)}), {});
  // Moved by a px or two, in another order, one of them backwards, and a new line before all.
  PieceSet later = numberedSet({wavy(400, 700), wavy(3, 296, 101.5), wavy(0, 290, -1.0), wavy(5, 300, 52.0)});
  std::reverse(later.pieces[1].points.begin(), later.pieces[1].points.end());
  EXPECT_EQ(numberPieces(later, first.known).ofPiece, (Numbers{4, 3, 1, 2}));
}

TEST(PieceNumbers, TheLongerPartKeepsTheNumberAndTheWholeGetsItBack) {
  const PieceNumbers whole = numberPieces(numberedSet({wavy(0, 300), wavy(0, 300, 50)}), {});
  for (const double cut : {40.0, 260.0}) {
    const PieceNumbers parts = numberPieces(numberedSet({wavy(0, cut), wavy(cut, 300), wavy(0, 300, 50)}), whole.known);
    EXPECT_EQ(parts.ofPiece, (cut < 150.0 ? Numbers{3, 1, 2} : Numbers{1, 3, 2})) << cut;
    const PieceNumbers again = numberPieces(numberedSet({wavy(0, 300), wavy(0, 300, 50)}), parts.known);
    EXPECT_EQ(again.ofPiece, (Numbers{1, 2})) << cut;
    // The part has its number once it is there again, and no other line has had it in between.
    const PieceNumbers other = numberPieces(numberedSet({wavy(0, 300), wavy(0, 300, 50), wavy(500, 800)}), again.known);
    EXPECT_EQ(other.ofPiece, (Numbers{1, 2, 4})) << cut;
    const PieceNumbers back = numberPieces(numberedSet({wavy(0, cut), wavy(cut, 300), wavy(0, 300, 50)}), other.known);
    EXPECT_EQ(back.ofPiece, parts.ofPiece) << cut;
  }
}

TEST(PieceNumbers, ANumberIsNeverGivenToAnotherLine) {
  const PieceNumbers first = numberPieces(numberedSet({wavy(0, 300), wavy(0, 300, 50)}), {});
  const PieceNumbers gone = numberPieces(numberedSet({wavy(0, 300)}), first.known);
  EXPECT_EQ(gone.ofPiece, Numbers{1});
  // One that crosses where the lost line ran, once, is another line.
  Piece crossing;
  for (double y = 0.0; y <= 400.0; y += 1.0) crossing.points.push_back({Vec2(150.0, y)});
  EXPECT_EQ(numberPieces(numberedSet({crossing, wavy(0, 300)}), gone.known).ofPiece, (Numbers{3, 1}));
  EXPECT_EQ(numberPieces(numberedSet({wavy(0, 300), wavy(0, 300, 50)}), gone.known).ofPiece, (Numbers{1, 2}));
}

TEST(PieceNumbers, TheTwoBordersOfAThinStrokeKeepTheirsWhenOneGoes) {
  const PieceNumbers both = numberPieces(numberedSet({wavy(0, 300), wavy(0, 300, 3.0)}), {});
  EXPECT_EQ(numberPieces(numberedSet({wavy(0, 300, 3.0)}), both.known).ofPiece, Numbers{2});
}

TEST(PieceNumbers, AreDifferentAndGrowOnlyThroughRandomChanges) {
  std::mt19937 random(3);
  CurveNumbers known;
  int last = 0;
  for (int round = 0; round < 200; ++round) {
    PieceSet set;
    for (int line = 0; line < 12; ++line) {
      if (random() % 4 == 0) continue;
      const double cut = 20.0 + random() % 260;
      if (random() % 3 == 0) {
        set.pieces.push_back(wavy(0, cut, 15.0 * line));
        set.pieces.push_back(wavy(cut, 300, 15.0 * line));
      } else {
        set.pieces.push_back(wavy(0, 300, 15.0 * line + random() % 3));
      }
    }
    std::shuffle(set.pieces.begin(), set.pieces.end(), random);
    const PieceNumbers numbers = numberPieces(set, known);
    ASSERT_EQ(numbers.ofPiece.size(), set.pieces.size());
    const std::set<int> different(numbers.ofPiece.begin(), numbers.ofPiece.end());
    ASSERT_EQ(different.size(), set.pieces.size());
    ASSERT_GE(*different.begin(), 1);
    ASSERT_GE(numbers.known.lastGiven, last);
    ASSERT_LE(*different.rbegin(), numbers.known.lastGiven);
    // The same lines ask for no further number.
    ASSERT_EQ(numberPieces(set, numbers.known).ofPiece, numbers.ofPiece);
    known = numbers.known;
    last = known.lastGiven;
  }
}

TEST(PieceNumbers, NoLongHistoryMakesThemEndless) {
  CurveNumbers known;
  known.lastGiven = 50000;
  for (int i = 1; i <= 20000; ++i) known.curves.push_back({i, {Vec2(5000.0 + i, 9000.0)}});
  const PieceNumbers numbers = numberPieces(numberedSet({wavy(0, 300)}), known);
  EXPECT_EQ(numbers.ofPiece, Numbers{50001});
  EXPECT_LE(numbers.known.curves.size(), 6000u);
  EXPECT_EQ(numbers.known.curves[1].number, 1) << "those of the result before are gone last";
}

TEST(PieceNumbers, ARunNumbersItsCurvesByTheRecipe) {
  const std::vector<Vec2> zigzag = {{40.0, 240.0}, {160.0, 60.0}, {280.0, 240.0}, {380.0, 60.0}};
  const Scan scan = test::renderPage(test::strokeCoverage(zigzag, false, 5.0, 420, 300), 420, 300, test::cleanPage());
  StageCache cache;
  Recipe recipe;
  const PipelineOutput first = runPipeline(scan, recipe, cache, {}, {});
  ASSERT_FALSE(first.error) << first.error->message;
  ASSERT_FALSE(first.faired->curves.empty());
  EXPECT_EQ(curveNumber(first, first.faired->curves.front()), 1);
  recipe.curveNumbers = first.numbers->known;
  for (NumberedCurve& curve : recipe.curveNumbers.curves) curve.number += 40;
  recipe.curveNumbers.lastGiven += 40;
  // Through the file, as the command line gets it from the window; nothing but the numbers is made anew.
  const auto read = recipeFromJson(recipeToJson(recipe));
  ASSERT_TRUE(read) << read.error().message;
  const PipelineOutput second = runPipeline(scan, *read, cache, {}, {});
  ASSERT_FALSE(second.error);
  EXPECT_EQ(second.faired, first.faired);
  for (const TracedCurve& curve : second.faired->curves)
    EXPECT_EQ(curveNumber(second, curve), curveNumber(first, curve) + 40);
}

}  // namespace
}  // namespace batten
