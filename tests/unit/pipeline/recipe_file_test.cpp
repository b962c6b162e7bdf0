// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/recipe_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "core/pipeline/recipe/parameter_table.h"

namespace batten {
namespace {

Recipe fullRecipe() {
  Recipe r;
  r.dpi = 299.7;
  r.log.factor = 45.123456789012345;
  r.threshold.grid[5] = 0.1 + 0.2;
  r.cornerMarks = {{Vec2(1.0 / 3.0, 2e-17)}, {Vec2(-4.5, 1e6 / 7.0)}};
  r.refusedCornersPx = {Vec2(1.0 / 7.0, 40.0), Vec2(-3.5, 2e5)};
  r.corners.automatic = false;
  r.fairing.mode = FairingMode::Tolerance;
  r.fairing.endHold = {true, true};
  r.choices = {{{Vec2(10.1, 20.2)}, false, std::nullopt, std::nullopt, std::nullopt},
               {{Vec2(0.3, 0.7)}, true, FairingMode::Target, FairingTarget::Degree4, 0.123},
               {{Vec2(3.0, 4.0), Vec2(1.0 / 3.0, 5.0)},
                true,
                FairingMode::Monotone,
                FairingTarget::Drawn,
                std::nullopt,
                12.5,
                KeptExtrema{3},
                {Vec2(1, 2)},
                {Vec2(5, 6), Vec2(1.0 / 7.0, 8)},
                {{0.0, 0.01}, {1.0 / 3.0, -0.02}, {1.0, 1e-9}}},
               {.anchorsPx = {Vec2(7.0, 8.0)},
                .mode = FairingMode::None,
                .target = std::nullopt,
                .toleranceMm = std::nullopt,
                .keepExtrema = KeptExtrema{},
                .spans = TargetSpans::Whole,
                .spanTargets = {{Vec2(1.0 / 3.0, 2.0), 1}, {Vec2(30.0, 40.5), 6}},
                .tolerancePolicy = TolerancePolicy::All,
                .means = FairingMeans::EdgeLengths,
                .startHold = EndHold{true, false},
                .endHold = EndHold{true, true},
                .method = ConstructMethod::Bezier,
                .isPart = true}};
  r.fairing.profile = {{0.0, 0.1}, {1.0, 0.2}};
  r.extremumChoices = {{Vec2(1.0 / 7.0, 300.5), true}, {Vec2(12.25, 1e-3), false}};
  r.regions = {rectangleRegion({1.0 / 3.0, 2.0}, {300.0, 4e2}), {{Vec2(0, 0), Vec2(10.1, 3.3), Vec2(-4, 9)}}};
  r.edges.choices = {{Vec2(1.0 / 3.0, 20.0), EdgeMode::Outline}, {Vec2(300.0, 4e2), EdgeMode::Centreline}};
  r.edges.painted = {{{Vec2(1.0 / 3.0, 20.0), Vec2(7, 8)}, 4.0 / 3.0, EdgeMode::Centreline},
                     {{Vec2(5, 6)}, 40.0, EdgeMode::Automatic}};
  r.edges.junctions = {{Vec2(1.0 / 3.0, 20.0), {{Vec2(1.0 / 7.0, 2.0), Vec2(3.5, 4e2)}, {Vec2(5, 6), Vec2(7, 8)}}},
                       {Vec2(300.0, 4e2), {}}};
  r.curveNumbers = {12, {{3, {Vec2(1.5, 20.0), Vec2(1.0 / 3.0, 7.0)}}, {12, {Vec2(300.1, 4.0)}}}};
  return r;
}

TEST(RecipeFile, HoldsAsFewExtremaAsCanBeAsMinusOne) {
  const std::string text = recipeToJson(fullRecipe());
  EXPECT_NE(text.find("\"keep_extrema\": 3"), std::string::npos) << text;
  EXPECT_NE(text.find("\"keep_extrema\": -1"), std::string::npos);
  EXPECT_NE(text.find("\"fairing.keep_extrema\": -1"), std::string::npos);
}

TEST(RecipeFile, ReadsBackExactly) {
  const auto read = recipeFromJson(recipeToJson(fullRecipe()));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, fullRecipe());
  const auto plain = recipeFromJson(recipeToJson(Recipe{}));
  ASSERT_TRUE(plain);
  EXPECT_EQ(*plain, Recipe{});
}

TEST(RecipeFile, RefusesNumbersOfCurvesThatCannotBe) {
  const auto with = [](const std::string& curves) {
    return recipeFromJson(R"({"format":"batten-recipe","version":1,"curves":)" + curves + "}");
  };
  EXPECT_TRUE(with(R"({"last":7,"known":[{"number":7,"places":[[1,2]]}]})"));
  for (const char* damaged :
       {"7", "{}", R"({"last":7})", R"({"last":1e300,"known":[]})", R"({"last":2000000000,"known":[]})",
        R"({"last":7,"known":[{"number":0,"places":[[1,2]]}]})", R"({"last":7,"known":[{"number":1,"places":[]}]})",
        R"({"last":7,"known":[{"number":1,"places":[[1,2]]},{"number":1,"places":[[1,2]]}]})",
        R"({"last":7,"known":[{"number":1,"places":[[1e9,2]]}]})", R"({"last":-1,"known":[]})"}) {
    const auto read = with(damaged);
    ASSERT_FALSE(read) << damaged;
    EXPECT_FALSE(read.error().message.empty());
  }
}

TEST(RecipeFile, KeepsEveryDoubleOfRandomRecipes) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 50; ++i) {
    Recipe r;
    for (const Parameter& p : parameterTable()) {
      if (p.type != ParameterType::Real) continue;
      std::uniform_real_distribution<double> value(p.minimum, p.maximum);
      char text[40];
      std::snprintf(text, sizeof text, "%.17g", value(random));
      ASSERT_TRUE(p.set(r, text)) << p.name;
    }
    const auto read = recipeFromJson(recipeToJson(r));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, r);
  }
}

TEST(RecipeFile, WritesAllParametersAndTakesDefaultsForMissingOnes) {
  const auto json = nlohmann::json::parse(recipeToJson(Recipe{}));
  EXPECT_EQ(json.at("parameters").size(), parameterTable().size());
  const auto read = recipeFromJson(R"({"format":"batten-recipe","version":1,"parameters":{"filter.iterations":3}})");
  ASSERT_TRUE(read);
  Recipe expected;
  expected.filter.iterations = 3;
  EXPECT_EQ(*read, expected);
}

void expectRefused(const std::string& text, const std::string& named) {
  const auto read = recipeFromJson(text);
  ASSERT_FALSE(read) << text;
  EXPECT_EQ(read.error().code, ErrorCode::BadParameter);
  EXPECT_NE(read.error().message.find(named), std::string::npos) << read.error().message;
}

TEST(RecipeFile, RefusesWhatItDoesNotKnowByName) {
  const std::string head = R"({"format":"batten-recipe","version":1,)";
  expectRefused(R"({"format":"other","version":1})", "not a Batten recipe");
  expectRefused("[1,2]", "not a Batten recipe");
  expectRefused(R"({"format":"batten-recipe","version":2})", "version 2");
  expectRefused(R"({"format":"batten-recipe"})", "version");
  expectRefused(head + R"("parameters":{"filter.colour":1}})", "filter.colour");
  expectRefused(head + R"("parameters":{"filter.iterations":101}})", "filter.iterations");
  expectRefused(head + R"("parameters":{"filter.iterations":[1]}})", "filter.iterations");
  expectRefused(head + R"("extra":1})", "extra");
  expectRefused(head + R"("corners":[[1,2],[3]]})", "corner");
  expectRefused(head + R"("choices":[{"target":2}]})", "anchor");
  expectRefused(head + R"("choices":[{"anchor":[1,2],"target":9}]})", "target");
  expectRefused(head + R"("choices":[{"anchor":[1,2],"splits":[[1]]}]})", "splits");
  expectRefused(head + R"("choices":[{"anchor":[1,2],"profile":[[0.5,1],[0.4,1]]}]})", "ascend");
  expectRefused(head + R"("choices":[{"anchor":[1,2],"low_pass":0}]})", "wavelength");
  expectRefused(head + R"("choices":[{"anchor":[1,2],"span_targets":[[1,2]]}]})", "span_targets");
  expectRefused(head + R"("choices":[{"anchor":[1,2],"span_targets":[[1,2,7]]}]})", "span");
  expectRefused(head + R"("corners":[{"at":[1,2],"round":1,"joint":"g4"}]})", "corner");
  expectRefused(head + R"("dpi":-3})", "resolution");
}

TEST(RecipeFile, EveryCutOffTextIsRefused) {
  const std::string text = recipeToJson(fullRecipe());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) expectRefused(text.substr(0, length), "damaged");
}

}  // namespace
}  // namespace batten
