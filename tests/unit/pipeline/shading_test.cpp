// SPDX-License-Identifier: GPL-3.0-or-later
// Lines on shading are traced as lines; kept shading is a shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/stress_page.h"

namespace batten {
namespace {

constexpr int kDiscWidth = 560, kDiscHeight = 460;
constexpr double kDiscRadius = 150.0, kInnerRadius = 90.0;

double fromDiscCentre(double x, double y) { return std::hypot(x - 280.0, y - 230.0); }

/// 0..1 of a place that is `inside` px within an edge, blurred.
double cover(double inside) { return 0.5 * std::erfc(-inside / (std::sqrt(2.0) * 0.8)); }

/// A grey disc with a drawn border and a circle drawn on it.
Scan shadedDisc() {
  const auto grey = [](double x, double y) {
    const double r = fromDiscCentre(x, y);
    const double ground = 240.0 - 140.0 * cover(kDiscRadius - r);
    const double from = std::min(std::abs(r - kDiscRadius), std::abs(r - kInnerRadius));
    return ground + (40.0 - ground) * cover(2.0 - from);
  };
  const std::vector<float> noInk(std::ptrdiff_t{kDiscWidth} * kDiscHeight, 0.0f);
  return test::renderStress(noInk, kDiscWidth, kDiscHeight, grey, {1.0, 2.0, 0.0}, 5);
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
  EXPECT_NEAR(radii[1], kDiscRadius, 0.3) << "one side of it is tone, the other paper";
  ASSERT_TRUE(findParameter("paper.shading")->set(recipe, "keep"));
  const auto kept = runPipeline(scan, recipe, cache, {}, {});
  ASSERT_FALSE(kept.error) << kept.error->message;
  ASSERT_FALSE(radiiOf(kept).empty());
  EXPECT_GT(std::abs(radiiOf(kept).back() - kDiscRadius), 1.0) << "the tone is ink, and its line is not found";
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
