// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/curve_stages.h"
#include "core/pipeline/run/piece_choices.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

/// The part of a wavy line from x = `from` to `to`, `down` px below the first one, a point every px.
Piece wave(double from, double to, double down = 0.0) {
  Piece piece;
  for (double x = from; x <= to; x += 1.0) {
    piece.points.push_back({Vec2(x, 200.0 + down + 40.0 * std::sin(2.0 * std::numbers::pi * x / 400.0))});
  }
  piece.lengthPx = to - from;
  return piece;
}

PieceSet setOf(std::vector<Piece> pieces) {
  PieceSet set;
  set.pieces = std::move(pieces);
  return set;
}

/// Choices of which the one for this piece leaves it out.
std::vector<PieceChoice> withoutPiece(const PieceSet& set, std::size_t piece) {
  std::vector<PieceChoice> choices;
  choices[makeOwnChoice(choices, set, piece)].included = false;
  return choices;
}

std::vector<std::optional<std::size_t>> ownersOf(const PieceSet& set, const std::vector<PieceChoice>& choices) {
  return assignChoices(set, choices).ofPiece;
}
using Owners = std::vector<std::optional<std::size_t>>;

TEST(PieceChoices, EveryPartOfALineThatSplitsKeepsItsChoice) {
  const std::vector<PieceChoice> choices = withoutPiece(setOf({wave(0, 1000)}), 0);
  EXPECT_LT(choices[0].anchorsPx.size(), 60u);
  // Broken up as a faint line is: long parts, dashes of 15 px, and moved by a px or two.
  const PieceSet parts = setOf({wave(2, 400, 1.0), wave(420, 435, 1.5), wave(450, 465, -1.5), wave(480, 1005)});
  EXPECT_EQ(ownersOf(parts, choices), (Owners{0, 0, 0, 0}));
  EXPECT_TRUE(assignChoices(parts, choices).waiting.empty());
}

TEST(PieceChoices, TheShortestPiecesOwnTheirChoice) {
  for (const double length : {1.0, 2.0, 3.0, 4.0, 9.0}) {
    const PieceSet set = setOf({wave(0, 40), wave(40, 40 + length), wave(40 + length, 200)});
    EXPECT_EQ(ownersOf(set, withoutPiece(set, 1)), (Owners{std::nullopt, 0, std::nullopt})) << length;
  }
}

TEST(PieceChoices, ALineTwelvePixelsAwayIsNotTaken) {
  for (const double away : {12.0, -12.0}) {
    const PieceSet both = setOf({wave(0, 1000, away), wave(0, 1000)});
    std::vector<PieceChoice> choices = withoutPiece(both, 1);
    EXPECT_EQ(ownersOf(both, choices), (Owners{std::nullopt, 0}));
    const PieceSet split = setOf({wave(0, 1000, away), wave(0, 300), wave(340, 360), wave(420, 1000)});
    EXPECT_EQ(ownersOf(split, choices), (Owners{std::nullopt, 0, 0, 0}));
    const PieceSet dashes = setOf({wave(0, 480, away), wave(480, 500, away), wave(520, 1000, away), wave(0, 1000)});
    EXPECT_EQ(ownersOf(dashes, choices), (Owners{std::nullopt, std::nullopt, std::nullopt, 0}));
    // Both have one, each its own.
    choices[makeOwnChoice(choices, both, 0)].included = false;
    EXPECT_EQ(ownersOf(both, choices), (Owners{1, 0}));
  }
}

TEST(PieceChoices, AChoiceWaitsWhileItsLineIsGone) {
  const PieceSet both = setOf({wave(0, 1000, 12.0), wave(0, 1000)});
  const std::vector<PieceChoice> choices = withoutPiece(both, 1);
  const ChoiceOwners gone = assignChoices(setOf({both.pieces[0]}), choices);
  EXPECT_EQ(gone.ofPiece, (Owners{std::nullopt}));
  EXPECT_EQ(gone.waiting, std::vector<std::size_t>{0});
  EXPECT_EQ(ownersOf(both, choices), (Owners{std::nullopt, 0}));
  // Nobody is told of a choice that says nothing.
  std::vector<PieceChoice> empty = choices;
  empty[0].included = true;
  EXPECT_TRUE(assignChoices(setOf({both.pieces[0]}), empty).waiting.empty());
}

TEST(PieceChoices, AShortLineThatIsJoinedToALongOneDoesNotTakeItAlong) {
  const std::vector<PieceChoice> choices = withoutPiece(setOf({wave(0, 200), wave(210, 1000)}), 0);
  const ChoiceOwners joined = assignChoices(setOf({wave(0, 1000)}), choices);
  EXPECT_EQ(joined.ofPiece, (Owners{std::nullopt}));
  EXPECT_EQ(joined.waiting.size(), 1u);
}

TEST(PieceChoices, TheNextPartBehindACornerIsNotTaken) {
  Piece next;  // goes on from the end of the line, and is no longer than the reach
  for (double d = 0.0; d <= 7.0; d += 1.0) next.points.push_back({wave(0, 500).points.back().at + d * Vec2(0.8, 0.6)});
  const PieceSet set = setOf({next, wave(0, 500)});
  EXPECT_EQ(ownersOf(set, withoutPiece(set, 1)), (Owners{std::nullopt, 0}));
}

TEST(PieceChoices, APartThatIsChangedLeavesTheOthersAsTheyAre) {
  const PieceSet whole = setOf({wave(0, 1000)}), parts = setOf({wave(0, 300), wave(300, 600), wave(600, 1000)});
  std::vector<PieceChoice> choices;
  PieceChoice& own = choices[makeOwnChoice(choices, whole, 0)];
  own.included = false;
  own.method = ConstructMethod::Bezier;
  ASSERT_EQ(ownersOf(parts, choices), (Owners{0, 0, 0}));
  const std::size_t middle = makeOwnChoice(choices, parts, 1);
  EXPECT_FALSE(choices[middle].included) << "begins as what it shared";
  choices[middle] = {.anchorsPx = choices[middle].anchorsPx, .isPart = choices[middle].isPart};
  EXPECT_EQ(ownersOf(parts, choices), (Owners{0, 1, 0}));
  EXPECT_EQ(makeOwnChoice(choices, parts, 1), 1u) << "it has its own one now";
  Recipe recipe;
  recipe.choices = choices;
  const std::vector<PieceChoice> methods = choicesForMethods(recipe);
  const Owners method = ownersOf(parts, methods);
  EXPECT_TRUE(methods[*method[0]].method);
  EXPECT_FALSE(methods[*method[1]].method) << "back to the common method";
  EXPECT_EQ(ownersOf(whole, choices), (Owners{0})) << "whole again";
}

TEST(PieceChoices, AClosedLineIsKnownAllAround) {
  Piece circle;
  for (int i = 0; i < 600; ++i)
    circle.points.push_back({300.0 * Vec2::Ones() + 100.0 * Vec2(std::cos(i * std::numbers::pi / 300.0),
                                                                 std::sin(i * std::numbers::pi / 300.0))});
  circle.closed = true;
  const PieceSet set = setOf({circle});
  const std::vector<PieceChoice> choices = withoutPiece(set, 0);
  EXPECT_EQ(choices[0].anchorsPx.front(), choices[0].anchorsPx.back());
  Piece aroundTheSeam = circle;
  aroundTheSeam.closed = false;
  aroundTheSeam.points.assign(circle.points.end() - 20, circle.points.end());
  aroundTheSeam.points.insert(aroundTheSeam.points.end(), circle.points.begin(), circle.points.begin() + 20);
  EXPECT_EQ(ownersOf(setOf({aroundTheSeam}), choices), (Owners{0}));
}

TEST(PieceChoices, ARecipeWithSingleAnchorsIsReadAndActsAsItDid) {
  const auto old =
      recipeFromJson(R"({"format":"batten-recipe","version":1,"choices":[{"anchor":[500,222],"included":false}]})");
  ASSERT_TRUE(old) << old.error().message;
  ASSERT_EQ(old->choices.size(), 1u);
  EXPECT_EQ(old->choices[0].anchorsPx, std::vector<Vec2>{Vec2(500, 222)});
  const PieceSet lines = setOf({wave(0, 1000, 50.0), wave(0, 1000)});
  EXPECT_EQ(ownersOf(lines, old->choices), (Owners{std::nullopt, 0})) << "up to 24 px away, the nearest";
  EXPECT_NE(recipeToJson(*old).find("\"anchor\""), std::string::npos) << "and is written as it was";
  // Edited, it is attached along its whole line.
  std::vector<PieceChoice> edited = old->choices;
  EXPECT_EQ(makeOwnChoice(edited, lines, 1), 0u);
  EXPECT_GT(edited[0].anchorsPx.size(), 10u);
}

/// The page of a line that gets fainter in two places, above another one.
Scan fadingPage() {
  constexpr int kWidth = 700, kHeight = 300;
  const auto coverage = [](double y) {
    return test::strokeCoverage({Vec2(40, y), Vec2(350, y + 30), Vec2(660, y)}, false, 4.0, kWidth, kHeight);
  };
  std::vector<float> ink = coverage(100.0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if ((x > 200 && x < 240) || (x > 440 && x < 480)) ink[y * kWidth + x] *= 0.25f;
    }
  }
  test::inkOver(ink, coverage(200.0));
  return test::renderPage(ink, kWidth, kHeight, test::cleanPage());
}

TEST(PieceChoices, ALineLeftOutStaysOutWhereAThresholdBreaksIt) {
  const Scan page = fadingPage();
  StageCache cache;
  Recipe recipe;
  recipe.edges.mode = EdgeMode::Centreline;
  recipe.edges.gapFactor = 0.0;
  recipe.threshold.reach = 1.0;
  recipe.threshold.mode = ThresholdMode::Manual;
  const auto run = [&](double level) {
    recipe.threshold.manualLevel = level;
    return runPipeline(page, recipe, cache, {}, {});
  };
  const auto whole = run(220.0);
  ASSERT_FALSE(whole.error) << whole.error->message;
  ASSERT_EQ(whole.pieces->pieces.size(), 2u);
  const std::size_t upper = anchorOf(whole.pieces->pieces[0]).y() < 150.0 ? 0 : 1;
  recipe.choices = withoutPiece(*whole.pieces, upper);
  for (const double level : {220.0, 120.0, 220.0}) {
    const auto out = run(level);
    ASSERT_FALSE(out.error) << out.error->message;
    EXPECT_EQ(out.faired->curves.size(), level < 200.0 ? 4u : 2u) << level;
    for (const TracedCurve& curve : out.faired->curves) {
      const Piece& piece = out.pieces->pieces[curve.piece];
      EXPECT_EQ(curve.included, anchorOf(piece).y() > 150.0) << level << ": " << anchorOf(piece).transpose();
    }
    EXPECT_TRUE(assignChoices(*out.pieces, recipe.choices).waiting.empty());
  }
  // The pieces of a line that is cut at a new corner share its choice, too.
  recipe.cornerMarks = {{Vec2(350, 130)}};
  const auto cut = run(220.0);
  ASSERT_EQ(cut.faired->curves.size(), 3u);
  EXPECT_EQ(std::count_if(cut.faired->curves.begin(), cut.faired->curves.end(),
                          [](const TracedCurve& curve) { return curve.included; }),
            1);
}

}  // namespace
}  // namespace batten
