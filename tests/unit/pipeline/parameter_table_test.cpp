// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/parameter_table.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/base/number_text.h"
#include "tests/unit/pipeline/other_value.h"

namespace batten {
namespace {

TEST(ParameterTable, EveryEntryIsDescribed) {
  std::set<std::string> names;
  for (const Parameter& p : parameterTable()) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
    EXPECT_NE(p.name.find('.'), std::string::npos) << p.name;
    EXPECT_FALSE(p.label.empty()) << p.name;
    EXPECT_GT(p.help.size(), 20u) << p.name;
    EXPECT_EQ(p.help.find('\n'), std::string::npos) << p.name;
    if (p.type == ParameterType::Choice) {
      EXPECT_EQ(p.choices.size(), p.choiceLabels.size()) << p.name;
    }
    if (p.type == ParameterType::Integer || p.type == ParameterType::Real) {
      EXPECT_LT(p.minimum, p.maximum) << p.name;
    }
    if (p.logarithmic && p.type == ParameterType::Real) {
      EXPECT_GE(p.minimum, 0.0) << p.name;
    }
  }
}

// Names never change once released: recipes and scripts hold them.
TEST(ParameterTable, HoldsThePromisedNames) {
  const std::set<std::string> promised = {"construct.closeness",
                                          "construct.degree",
                                          "construct.derivative_magnitude",
                                          "construct.detail",
                                          "construct.ends",
                                          "construct.equalise",
                                          "construct.gradients",
                                          "construct.growing_as_in_paper",
                                          "construct.growing_stop",
                                          "construct.keep_extrema",
                                          "construct.knots",
                                          "construct.light",
                                          "construct.light_tolerance",
                                          "construct.lowpass",
                                          "construct.magnitude_as_in_paper",
                                          "construct.method",
                                          "construct.reduce",
                                          "construct.removal",
                                          "construct.removal_step",
                                          "construct.removal_tolerance",
                                          "construct.smooth_ragged",
                                          "construct.start",
                                          "construct.typical",
                                          "contours.max_count",
                                          "contours.min_length",
                                          "contours.min_widths",
                                          "corners.auto",
                                          "corners.exact",
                                          "corners.snap",
                                          "edges.bend",
                                          "edges.gap",
                                          "edges.intent",
                                          "edges.internal",
                                          "edges.merge",
                                          "edges.mode",
                                          "edges.spur",
                                          "edges.stroke_width",
                                          "edges.subpixel",
                                          "fairing.alpha",
                                          "fairing.choose",
                                          "fairing.hold_end",
                                          "fairing.hold_start",
                                          "fairing.keep_extrema",
                                          "fairing.lowpass",
                                          "fairing.mode",
                                          "fairing.monotone",
                                          "fairing.moves",
                                          "fairing.profile",
                                          "fairing.quantity",
                                          "fairing.samples",
                                          "fairing.spans",
                                          "fairing.spend",
                                          "fairing.target",
                                          "fairing.tolerance",
                                          "filter.border",
                                          "filter.coefficient",
                                          "filter.iterations",
                                          "filter.max_change",
                                          "filter.order",
                                          "inks.drop",
                                          "inks.keep",
                                          "inks.range",
                                          "log.enabled",
                                          "log.factor",
                                          "paper.colour",
                                          "paper.flatten",
                                          "paper.folds",
                                          "paper.format",
                                          "paper.lines",
                                          "paper.rectify",
                                          "paper.rulings",
                                          "paper.shading",
                                          "paper.sheet",
                                          "segments.count",
                                          "segments.mode",
                                          "segments.spacing",
                                          "segments.tolerance",
                                          "threshold.grid",
                                          "threshold.hole_area",
                                          "threshold.interpolate",
                                          "threshold.level",
                                          "threshold.mode",
                                          "threshold.reach",
                                          "threshold.smooth",
                                          "threshold.speck_area",
                                          "threshold.strength"};
  std::set<std::string> names;
  for (const Parameter& p : parameterTable()) names.insert(p.name);
  EXPECT_EQ(names, promised);
}

TEST(ParameterTable, EveryEntryRoundTripsAndTouchesOnlyItself) {
  for (const Parameter& p : parameterTable()) {
    Recipe recipe;
    const std::string value = test::otherValue(p);
    ASSERT_TRUE(p.set(recipe, value)) << p.name << " = " << value;
    EXPECT_EQ(p.get(recipe), value) << p.name;
    EXPECT_FALSE(recipe == Recipe{}) << p.name << " changes nothing";
    for (const Parameter& q : parameterTable()) {
      if (q.name != p.name) {
        EXPECT_EQ(q.get(recipe), defaultValue(q)) << p.name << " changes " << q.name;
      }
    }
    ASSERT_TRUE(p.set(recipe, defaultValue(p))) << p.name;
    EXPECT_EQ(recipe, Recipe{}) << p.name;
  }
}

TEST(ParameterTable, DefaultsAndBordersOfEveryRangeAreValid) {
  EXPECT_FALSE(validate(Recipe{}));
  for (const Parameter& p : parameterTable()) {
    if (p.type != ParameterType::Integer && p.type != ParameterType::Real) continue;
    for (const double border : {p.minimum, p.maximum}) {
      Recipe recipe;
      ASSERT_TRUE(p.set(recipe, numberToText(border))) << p.name;
      const auto error = validate(recipe);
      EXPECT_FALSE(error) << p.name << " = " << border << ": " << error->message;
    }
  }
}

TEST(ParameterTable, RefusesWhatDoesNotFitAndLeavesTheRecipe) {
  for (const Parameter& p : parameterTable()) {
    for (const std::string bad : {"", "nonsense", "nan", "inf", "1e999", "-1e9", "1,5", "1 2"}) {
      if (p.name.starts_with("inks.") && bad == "1,5") continue;  // a list
      Recipe recipe;
      const auto result = p.set(recipe, bad);
      ASSERT_FALSE(result) << p.name << " took \"" << bad << "\"";
      EXPECT_EQ(result.error().code, ErrorCode::BadParameter);
      EXPECT_NE(result.error().message.find(p.name), std::string::npos) << result.error().message;
      EXPECT_EQ(recipe, Recipe{});
    }
  }
  Recipe recipe;
  EXPECT_FALSE(setParameter(recipe, "segments.count", "1"));
  EXPECT_TRUE(setParameter(recipe, "segments.count", "4"));
  EXPECT_FALSE(setParameter(recipe, "filter.coefficient", "2.5"));
}

TEST(ParameterTable, UnknownNamesSuggestTheNearest) {
  Recipe recipe;
  const auto typo = setParameter(recipe, "filter.coeficient", "2");
  ASSERT_FALSE(typo);
  EXPECT_NE(typo.error().message.find("filter.coefficient"), std::string::npos);
  const auto bare = setParameter(recipe, "tolerance", "2");
  ASSERT_FALSE(bare);
  EXPECT_NE(bare.error().message.find("tolerance?"), std::string::npos);
}

TEST(ParameterTable, TheGridTakesSixtyFourEntries) {
  Recipe recipe;
  EXPECT_FALSE(setParameter(recipe, "threshold.grid", "1,2,3"));
  std::string many = "a";
  for (int i = 1; i < kRegions + 1; ++i) many += ",a";
  EXPECT_FALSE(setParameter(recipe, "threshold.grid", many));
  EXPECT_FALSE(setParameter(recipe, "threshold.grid", many.substr(4) + ",256"));
  ASSERT_TRUE(setParameter(recipe, "threshold.grid", many.substr(4) + " , 99.5"));
  EXPECT_EQ(recipe.threshold.grid[63], 99.5);
  EXPECT_FALSE(recipe.threshold.grid[62].has_value());
}

TEST(NumberText, ReadsBackExactlyInThePlainForm) {
  for (const double v : {0.0, 0.1, 1.0 / 3.0, 100000.0, 1e-9, 5e-324, 1.7976931348623157e308, -45.98590442833571}) {
    EXPECT_EQ(numberFromText(numberToText(v)), v);
  }
  EXPECT_EQ(numberToText(100000.0), "100000");
  EXPECT_EQ(numberFromText(" +2.5 "), 2.5);
  EXPECT_EQ(numberFromText("+-2"), std::nullopt);
}

}  // namespace
}  // namespace batten
