// SPDX-License-Identifier: GPL-3.0-or-later
// Lines on shading are traced as lines; kept shading is a shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/stress_page.h"

namespace batten {
namespace {

constexpr int kDiscWidth = 560, kDiscHeight = 460;
constexpr double kDiscRadius = 150.0, kInnerRadius = 90.0;

double fromDiscCentre(double x, double y) { return std::hypot(x - 280.0, y - 230.0); }

/// A grey disc with a drawn border and a circle drawn on it.
Scan shadedDisc() {
  std::vector<float> coverage;
  for (int y = 0; y < kDiscHeight; ++y)
    for (int x = 0; x < kDiscWidth; ++x) {
      const double r = fromDiscCentre(x + 0.5, y + 0.5);
      const double from = std::min(std::abs(r - kDiscRadius), std::abs(r - kInnerRadius));
      coverage.push_back(static_cast<float>(std::clamp(2.0 - from, 0.0, 1.0)));
    }
  const auto paper = [](double x, double y) { return fromDiscCentre(x, y) < kDiscRadius ? 160.0 : 240.0; };
  return test::renderStress(std::move(coverage), kDiscWidth, kDiscHeight, paper, {110.0, 2.0, 0.8}, 5);
}

/// Mean radius of each centre line, smallest first.
std::vector<double> radiiOf(const PipelineOutput& out) {
  std::vector<double> radii;
  for (const Contour& c : out.contours->contours) {
    if (c.kind != ContourKind::Centreline) continue;
    double sum = 0.0;
    for (const ContourPoint& p : c.points) sum += fromDiscCentre(p.at.x(), p.at.y());
    radii.push_back(sum / static_cast<double>(std::ssize(c.points)));
  }
  std::sort(radii.begin(), radii.end());
  return radii;
}

TEST(DrawnShading, LinesOnItAreTracedAsLines) {
  const Scan scan = shadedDisc();
  StageCache cache;
  Recipe recipe;
  const auto out = runPipeline(scan, recipe, cache, {}, {});
  ASSERT_FALSE(out.error) << out.error->message;
  const std::vector<double> radii = radiiOf(out);
  ASSERT_EQ(radii.size(), 2u);
  EXPECT_NEAR(radii[0], kInnerRadius, 0.1);
  EXPECT_NEAR(radii[1], kDiscRadius, 0.6) << "its darker side draws the line of the border inwards a little";
  ASSERT_TRUE(findParameter("paper.shading")->set(recipe, "keep"));
  const auto kept = runPipeline(scan, recipe, cache, {}, {});
  ASSERT_FALSE(kept.error) << kept.error->message;
  EXPECT_LT(radiiOf(kept).size(), 2u);
}

TEST(DrawnShading, IsKeptWherePaperIsNotFlattened) {
  StageCache cache;
  Recipe recipe;
  recipe.paper.flatten = false;
  const auto out = runPipeline(shadedDisc(), recipe, cache, {}, {});
  ASSERT_TRUE(out.page);
  EXPECT_EQ(out.page->shadedShare, 0.0);
}

}  // namespace
}  // namespace batten
