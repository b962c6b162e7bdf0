// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/recipe_places.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/image/rectified_scan.h"
#include "core/image/rectify/sheet_map.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/pipeline.h"
#include "core/pipeline/run/stage_keys.h"
#include "tests/support/photo_page.h"

namespace batten {
namespace {

constexpr int kWidth = 900, kHeight = 1200;

/// Every kind of place, each at its own.
Recipe withAllPlaces() {
  Recipe recipe;
  recipe.penStrokes.push_back({{Vec2(100, 110), Vec2(120, 130)}, false});
  recipe.regions.push_back({{Vec2(10, 10), Vec2(400, 12), Vec2(300, 420)}});
  recipe.edges.choices.push_back({Vec2(31, 41), EdgeMode::Outline});
  recipe.edges.painted.push_back({{Vec2(35, 45), Vec2(36, 47)}, 6.0, EdgeMode::Centreline});
  recipe.edges.junctions.push_back({Vec2(55, 66), {{Vec2(50, 60), Vec2(60, 70)}}});
  recipe.cornerMarks.push_back({Vec2(77, 88)});
  recipe.refusedCornersPx.emplace_back(79, 89);
  recipe.segmentPoints.push_back({Vec2(90, 91)});
  recipe.extremumChoices.push_back({Vec2(92, 93), true});
  PieceChoice choice;
  choice.anchorsPx = {Vec2(201, 202)};
  choice.keepPx = {Vec2(203, 204)};
  choice.splitsPx = {Vec2(205, 206)};
  choice.spanTargets.push_back({Vec2(207, 208), 2});
  recipe.choices.push_back(choice);
  recipe.curveNumbers = {3, {{2, {Vec2(301, 302)}}}};
  recipe.directions.push_back({Vec2(303, 304), Vec2(305, 306)});
  recipe.starts.push_back({Vec2(307, 308)});
  setScaleLine(recipe, {Vec2(0, 0), Vec2(300, 0), 25.4});
  return recipe;
}

Rectification made(double tiltDeg, PaperFormat format = PaperFormat::Unknown) {
  const test::PhotoCamera camera({.tiltDeg = tiltDeg, .panDeg = 9.0, .rollDeg = 3.0}, kWidth, kHeight);
  Scan scan;
  scan.grey = GreyImage(kWidth, kHeight);
  return *rectificationOf(scan, camera.corners(), format);
}

// The file names every place, each as the first two numbers of a list: both must have been moved, and nothing else.
TEST(RecipePlaces, NoPlaceIsForgotten) {
  const Recipe before = withAllPlaces();
  Recipe after = before;
  movePlaces(
      after, [](const Vec2& place) { return Vec2(place.x() + 5000.0, place.y() + 7000.0); }, 1.0);
  const auto file = nlohmann::json::parse(recipeToJson(before)), moved = nlohmann::json::parse(recipeToJson(after));
  const auto numbers = file.flatten(), movedNumbers = moved.flatten();
  ASSERT_EQ(numbers.size(), movedNumbers.size());
  int places = 0;
  for (const auto& [name, value] : numbers.items()) {
    const nlohmann::json::json_pointer pointer(name);
    const auto& list = file.at(pointer.parent_pointer());
    const bool isPlace = list.is_array() && list.size() >= 2 && list[0].is_number();
    if (!isPlace || (pointer.back() != "0" && pointer.back() != "1")) {
      EXPECT_EQ(movedNumbers.at(name), value) << name;
      continue;
    }
    const double step = pointer.back() == "0" ? 5000.0 : 7000.0;
    EXPECT_EQ(movedNumbers.at(name).get<double>(), value.get<double>() + step) << name;
    places += pointer.back() == "0" ? 1 : 0;
  }
  EXPECT_EQ(places, 25) << "of withAllPlaces()";
}

TEST(RecipePlaces, AreOnTheSameInkOfARectifiedPageAndComeBack) {
  const Recipe before = withAllPlaces();
  const Rectification first = made(20.0), second = made(-12.0);
  const Recipe rectified = rectifiedRecipe(before, std::nullopt, first, withCorners({}, first.cornersPx));
  EXPECT_EQ(rectified.preparation.rectify.use, RectifyUse::Corners);
  EXPECT_LT((SheetMap(first).toPicture(rectified.cornerMarks[0].positionPx) - Vec2(77, 88)).norm(), 1e-8);
  const Recipe other = rectifiedRecipe(rectified, first, second, withCorners({}, second.cornersPx));
  EXPECT_LT((SheetMap(second).toPicture(other.starts[0].positionPx) - Vec2(307, 308)).norm(), 1e-8);
  const Recipe back = rectifiedRecipe(other, second, std::nullopt, {});
  EXPECT_LT((back.choices[0].splitsPx[0] - Vec2(205, 206)).norm(), 1e-7);
  EXPECT_NEAR(*back.dpi, 300.0, 1e-6) << "measured anew on the same line";
  EXPECT_NEAR(rectified.edges.painted[0].radiusPx, 6.0 * first.scale, 1e-9) << "as wide on the ink";
  EXPECT_NEAR(back.edges.painted[0].radiusPx, 6.0, 1e-9);
  EXPECT_FALSE(validate(rectified));
}

TEST(RecipePlaces, AStatedResolutionFollowsThePageOrGivesWayToTheFormat) {
  Recipe before;
  before.dpi = 150.0;
  const Rectification unknown = made(20.0), known = made(20.0, PaperFormat::A4);
  const Recipe scaled = rectifiedRecipe(before, std::nullopt, unknown, withCorners({}, unknown.cornersPx));
  EXPECT_NEAR(*scaled.dpi, 150.0 * unknown.scale, 1e-9);
  EXPECT_NEAR(*rectifiedRecipe(scaled, unknown, std::nullopt, {}).dpi, 150.0, 1e-9);
  EXPECT_FALSE(rectifiedRecipe(before, std::nullopt, known, withCorners({}, known.cornersPx)).dpi);
}

TEST(RecipePlaces, PlacesBeyondTheHorizonAreNoneOfThePage) {
  const test::PhotoCamera steep({.tiltDeg = -60.0, .fill = 0.5}, kWidth, kHeight);
  Scan scan;
  scan.grey = GreyImage(kWidth, kHeight);
  const auto rectification = rectificationOf(scan, steep.corners(), PaperFormat::Unknown);
  ASSERT_TRUE(rectification) << rectification.error().message;
  Recipe recipe;
  for (double y = -3000.0; y <= 4000.0; y += 250.0) recipe.starts.push_back({Vec2(450.0, y)});
  const Recipe after = rectifiedRecipe(recipe, std::nullopt, *rectification, withCorners({}, rectification->cornersPx));
  EXPECT_FALSE(validate(after));
  int outside = 0;
  for (const StartMark& mark : after.starts) outside += mark.positionPx.x() < 0.0 ? 1 : 0;
  EXPECT_GT(outside, 0);
}

TEST(RectifyParameter, IsReadWrittenAndRefused) {
  Recipe recipe;
  const auto set = [&](std::string_view text) { return setParameter(recipe, "paper.rectify", text); };
  ASSERT_TRUE(set("10.5,20, 300 24;310,420.25 8,400"));
  EXPECT_EQ(recipe.preparation.rectify.use, RectifyUse::Corners);
  EXPECT_EQ(recipe.preparation.rectify.cornersPx[2], Vec2(310, 420.25));
  const auto again = recipeFromJson(recipeToJson(recipe));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, recipe);
  ASSERT_TRUE(set("auto"));
  EXPECT_EQ(recipe.preparation.rectify.use, RectifyUse::Automatic);
  ASSERT_TRUE(setParameter(recipe, "paper.format", "letter"));
  ASSERT_TRUE(set("off"));
  EXPECT_EQ(recipe.preparation.rectify.format, PaperFormat::Letter);
  for (const char* bad : {"", "yes", "1,2,3", "1,2,3,4,5,6,7,8,9", "1,2,3,4,5,6,7,x", "1,2,3,4,5,6,7,inf"}) {
    const auto refused = set(bad);
    ASSERT_FALSE(refused) << bad;
    EXPECT_NE(refused.error().message.find("paper.rectify"), std::string::npos);
  }
  EXPECT_FALSE(setParameter(recipe, "paper.format", "a11"));
}

// Another page of the same file is another input of every stage.
TEST(RectifyParameter, TheKeysOfAllStagesTellPagesApart) {
  Scan scan;
  scan.grey = GreyImage(kWidth, kHeight);
  scan.fileHash = HashBuilder().text("a file").finish();
  Scan other = scan;
  other.rectification = made(10.0);
  Scan third = scan;
  third.rectification = made(11.0);
  const Recipe recipe;
  const PageFrame frame = frameFor(scan, recipe);
  for (const StageId stage : kStages) {
    EXPECT_NE(stageKeys(scan, recipe, frame)[stage], stageKeys(other, recipe, frame)[stage]);
    EXPECT_NE(stageKeys(third, recipe, frame)[stage], stageKeys(other, recipe, frame)[stage]);
  }
}

}  // namespace
}  // namespace batten
