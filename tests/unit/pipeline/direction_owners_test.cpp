// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/direction_owners.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/pipeline/recipe/recipe_file.h"

namespace batten {
namespace {

/// A line from left to right along y = 100, and a ring around (300, 300).
PieceSet lineAndRing() {
  PieceSet set;
  Piece& line = set.pieces.emplace_back();
  for (int x = 20; x <= 220; x += 2) line.points.push_back({Vec2(x, 100)});
  Piece& ring = set.pieces.emplace_back();
  ring.contour = 1;
  ring.closed = true;
  for (int i = 0; i < 200; ++i)
    ring.points.push_back({Vec2(300 + 80 * std::cos(M_PI * i / 100), 300 + 80 * std::sin(M_PI * i / 100))});
  return set;
}

TEST(DirectionOwners, AMarkTurnsWhatRunsAgainstItWhicheverWayItWasTraced) {
  PieceSet set = lineAndRing();
  Recipe recipe;
  recipe.directions = {{{60, 104}, {10, 104}}};  // towards the left
  auto owners = assignDirections(set, recipe);
  ASSERT_TRUE(owners.ofPiece[0]);
  EXPECT_TRUE(owners.ofPiece[0]->isReversed);
  EXPECT_FALSE(owners.ofPiece[1]);
  std::reverse(set.pieces[0].points.begin(), set.pieces[0].points.end());
  owners = assignDirections(set, recipe);
  EXPECT_FALSE(owners.ofPiece[0]->isReversed) << "it runs to the left already";
  recipe.directions = {{{60, 140}, {10, 140}}};
  EXPECT_FALSE(assignDirections(set, recipe).ofPiece[0]) << "too far away";
}

TEST(DirectionOwners, TurningTwiceIsNotTurning) {
  const PieceSet set = lineAndRing();
  Recipe recipe;
  reverseDirection(recipe, set, 0);
  EXPECT_TRUE(assignDirections(set, recipe).ofPiece[0]->isReversed);
  reverseDirection(recipe, set, 0);
  ASSERT_EQ(recipe.directions.size(), 1u) << "one mark a curve";
  EXPECT_FALSE(assignDirections(set, recipe).ofPiece[0]->isReversed);
  reverseDirection(recipe, set, 1);
  EXPECT_EQ(recipe.directions.size(), 2u);
}

TEST(DirectionOwners, AClosedLineHasOneStart) {
  const PieceSet set = lineAndRing();
  Recipe recipe;
  setStart(recipe, set, 1, {300, 380});
  setStart(recipe, set, 1, {220, 300});
  ASSERT_EQ(recipe.starts.size(), 1u);
  const auto owners = assignDirections(set, recipe);
  ASSERT_TRUE(owners.startOfContour.contains(1));
  EXPECT_EQ(recipe.starts[owners.startOfContour.at(1)].positionPx, Vec2(220, 300));
}

TEST(PlacedMarks, ScaleDirectionsAndStartsComeBackFromTheFile) {
  Recipe recipe;
  setScaleLine(recipe, {{100, 200}, {400, 600}, 127.0});
  EXPECT_DOUBLE_EQ(*recipe.dpi, 100.0);
  recipe.directions = {{{1.5, 2}, {3, 4.25}}};
  recipe.starts = {{{7, 8}}};
  const auto back = recipeFromJson(recipeToJson(recipe));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(*back == recipe);
  setResolution(recipe, 300.0);
  EXPECT_FALSE(recipe.scaleLine) << "the line said another one";
}

TEST(PlacedMarks, DamageIsRefused) {
  const auto refused = [](const std::string& entry) {
    const auto recipe = recipeFromJson(R"({"format":"batten-recipe","version":1,)" + entry + "}");
    return !recipe && recipe.error().code == ErrorCode::BadParameter;
  };
  EXPECT_TRUE(refused(R"("scale":[1,2,3])"));
  EXPECT_TRUE(refused(R"("scale":{"from":[1,1],"to":[1,1],"mm":10})")) << "no length on the page";
  EXPECT_TRUE(refused(R"("scale":{"from":[1,1],"to":[1,900],"mm":-10})"));
  EXPECT_TRUE(refused(R"("scale":{"from":[1,1],"to":[1,900]})"));
  EXPECT_TRUE(refused(R"("directions":[{"at":[1,1]}])"));
  EXPECT_TRUE(refused(R"("directions":[{"at":[1,1],"towards":[1,1]}])"));
  EXPECT_TRUE(refused(R"("directions":{})"));
  EXPECT_TRUE(refused(R"("starts":[[1,1e9]])"));
  EXPECT_TRUE(refused(R"("starts":[[1]])"));
  EXPECT_FALSE(refused(R"("starts":[[1,2]])"));
}

}  // namespace
}  // namespace batten
