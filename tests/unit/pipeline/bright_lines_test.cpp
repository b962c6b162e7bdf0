// SPDX-License-Identifier: GPL-3.0-or-later
// A page whose lines are brighter than its paper is inverted, and traced as its negative is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/stress_page.h"

namespace batten {
namespace {

/// Two circles and a wave of dark ink.
Scan darkLines() {
  constexpr int kWidth = 560, kHeight = 460;
  const auto grey = [](double x, double y) {
    const double r = std::hypot(x - 280.0, y - 200.0);
    const double wave = y - 420.0 - 12.0 * std::sin(0.03 * x);
    const double from = std::min({std::fabs(r - 60.0), std::fabs(r - 130.0), std::fabs(wave)});
    return 225.0 - 190.0 * 0.5 * std::erfc((from - 2.0) / (std::sqrt(2.0) * 0.8));
  };
  const std::vector<float> noInk(std::ptrdiff_t{kWidth} * kHeight, 0.0f);
  return test::renderStress(noInk, kWidth, kHeight, grey, {1.0, 2.0, 0.0}, 5);
}

Scan negativeOf(Scan scan) {
  for (std::uint16_t& value : scan.grey.pixels) value = static_cast<std::uint16_t>(~value);
  return scan;
}

/// Places of all points of all lines, in order.
std::vector<Vec2> placesOf(const PipelineOutput& out) {
  std::vector<Vec2> places;
  for (const Contour& c : out.contours->contours)
    for (const ContourPoint& p : c.points) places.push_back(p.at);
  return places;
}

TEST(BrightLines, AreTracedAsThoseOfTheNegative) {
  StageCache cache, other;
  const auto positive = runPipeline(darkLines(), Recipe(), cache, {}, {});
  const auto negative = runPipeline(negativeOf(darkLines()), Recipe(), other, {}, {});
  ASSERT_FALSE(positive.error) << positive.error->message;
  ASSERT_FALSE(negative.error) << negative.error->message;
  EXPECT_FALSE(positive.page->isInverted);
  EXPECT_TRUE(negative.page->isInverted);
  ASSERT_FALSE(placesOf(positive).empty());
  EXPECT_EQ(placesOf(negative), placesOf(positive));
  ASSERT_FALSE(negative.page->notes.empty());
  EXPECT_NE(negative.page->notes.front().find("paper.lines=darker"), std::string::npos);
}

TEST(BrightLines, AreWhatTheUserSays) {
  StageCache cache;
  Recipe recipe;
  ASSERT_TRUE(findParameter("paper.lines")->set(recipe, "darker"));
  EXPECT_FALSE(runPipeline(negativeOf(darkLines()), recipe, cache, {}, {}).page->isInverted);
  ASSERT_TRUE(findParameter("paper.lines")->set(recipe, "brighter"));
  EXPECT_TRUE(runPipeline(darkLines(), recipe, cache, {}, {}).page->isInverted);
  // Levels of the user are those of the scan.
  ASSERT_TRUE(findParameter("paper.lines")->set(recipe, "auto"));
  recipe.threshold.mode = ThresholdMode::Manual;
  EXPECT_FALSE(runPipeline(negativeOf(darkLines()), recipe, cache, {}, {}).page->isInverted);
}

}  // namespace
}  // namespace batten
