// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters and corner marks drawn at random from their ranges, over contour, construction and fairing of small pages.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/base/number_text.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/asked_count.h"
#include "tests/support/render_page.h"
#include "tests/support/truth_shapes.h"

namespace batten {
namespace {

constexpr int kPageWidthPx = 240, kPageHeightPx = 160;

std::vector<Scan> smallPages() {
  std::vector<Scan> pages;
  for (const char* shape : {"ellipse", "car", "clothoid"}) {
    const auto truth = test::truthShape(shape, kPageWidthPx, kPageHeightPx);
    pages.push_back(test::renderPage(test::fillCoverage(truth.outline(), kPageWidthPx, kPageHeightPx), kPageWidthPx,
                                     kPageHeightPx, test::scannedPage(3)));
  }
  return pages;
}

/// A value of the parameter's own range; its ends more often than chance would have it.
std::string valueOf(const Parameter& p, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  if (!p.choices.empty()) return p.choices[random() % p.choices.size()];
  if (p.type == ParameterType::Text) return p.get(Recipe{});
  const double end = share(random), at = end < 0.1 ? 0.0 : end > 0.9 ? 1.0 : share(random);
  const double value = p.minimum + at * (p.maximum - p.minimum);
  return p.type == ParameterType::Integer ? std::to_string(static_cast<int>(value)) : numberToText(value);
}

/// Most parameters stay as they are: drawn all at once, the image stages would leave no line to go on with.
Recipe randomRecipe(std::mt19937& random, std::string& settings) {
  Recipe recipe;
  for (const Parameter& p : parameterTable()) {
    if (random() % 4 != 0) continue;
    const std::string value = valueOf(p, random);
    EXPECT_TRUE(p.set(recipe, value)) << p.name << "=" << value << " is of its own range";
    settings += " --set " + p.name + "=" + value;
  }
  for (unsigned left = random() % 6; left > 0; --left) {
    recipe.cornerMarks.push_back(
        {Vec2(random() % kPageWidthPx, random() % kPageHeightPx), random() % 2 == 0 ? 0.0 : 1.5});
  }
  return recipe;
}

/// Sets of a case: 2; BATTEN_PARAMETER_SETS sets the number of all ten cases (packaging/check: 1000).
int setsOfACase() { return std::max(1, test::askedCount("BATTEN_PARAMETER_SETS", 20) / 10); }

class RandomParameters : public testing::TestWithParam<int> {};

TEST_P(RandomParameters, GiveFiniteCurvesOrAMessage) {
  const std::vector<Scan> pages = smallPages();
  std::mt19937 random(static_cast<unsigned>(500 + GetParam()));
  for (int trial = 0; trial < setsOfACase(); ++trial) {
    std::string settings;
    const Recipe recipe = randomRecipe(random, settings);
    const Scan& page = pages[random() % pages.size()];
    SCOPED_TRACE("set " + std::to_string(trial) + ":" + settings);
    if (validate(recipe)) continue;  // two values that do not go together are refused with a message
    StageCache nothingKept(0);
    RunContext context;
    context.threads = 1;
    const auto output = runPipeline(page, recipe, nothingKept, {}, context);
    if (output.error) {
      EXPECT_FALSE(output.error->message.empty());
      continue;
    }
    ASSERT_TRUE(output.faired);
    EXPECT_FALSE(output.faired->curves.empty());
    for (const auto& curve : output.faired->curves) {
      const auto& points = curve.faired.controlPoints();
      EXPECT_TRUE(std::all_of(points.begin(), points.end(), [](const Vec2& p) { return p.allFinite(); }));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(TenTimes, RandomParameters, testing::Range(0, 10));

}  // namespace
}  // namespace batten
