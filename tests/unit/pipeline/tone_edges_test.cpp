// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/curve/arc_length.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/angles.h"
#include "tests/support/stress_page.h"

namespace batten {
namespace {

using test::kPi;

constexpr int kToneWidth = 700, kToneHeight = 480;

/// Height of the open edge at x.
double openEdge(double x) { return 220.0 + 90.0 * std::sin(2.0 * kPi * x / 900.0); }

struct ToneCase {
  bool closed;
  double contrast, blurPx, noise, fadePx;  // fade 0: one tone
  double curvePx;                          // rms that the fair curve must reach
};

Scan tonePage(const ToneCase& c) {
  const auto paper = [&](double x, double y) {
    double inside = 0.0;
    if (c.closed) {
      inside = 160.0 - std::hypot(x - 350.0, y - 240.0);
    } else {
      const double slope = 0.2 * kPi * std::cos(2.0 * kPi * x / 900.0);
      inside = (y - openEdge(x)) / std::hypot(1.0, slope);
    }
    const double cover = 0.5 * std::erfc(-inside / (std::sqrt(2.0) * c.blurPx));
    return 235.0 - c.contrast * cover * (c.fadePx > 0.0 ? std::exp(-std::max(0.0, inside) / c.fadePx) : 1.0);
  };
  const std::vector<float> noInk(std::ptrdiff_t{kToneWidth} * kToneHeight, 0.0f);
  return test::renderStress(noInk, kToneWidth, kToneHeight, paper, {1.0, c.noise, 0.0}, 4);
}

std::vector<std::vector<Vec2>> toneTruth(const ToneCase& c) {
  std::vector<Vec2> line;
  for (int i = 0; i <= 1400; ++i) {
    const double f = i / 1400.0, a = 2.0 * kPi * f;
    line.push_back(c.closed ? Vec2(350.0 + 160.0 * std::cos(a), 240.0 + 160.0 * std::sin(a))
                            : Vec2(kToneWidth * f, openEdge(kToneWidth * f)));
  }
  return {line};
}

/// On a shaded drawing a tone ends at an edge without a line: outline mode follows it, and the curve lies on it.
TEST(ToneEdges, AreFollowedInOutlineMode) {
  for (const ToneCase& c :
       {ToneCase{true, 60, 1, 2, 0, 0.03}, ToneCase{true, 100, 3, 8, 0, 0.15}, ToneCase{true, 100, 4, 4, 0, 0.2},
        ToneCase{false, 100, 1, 8, 0, 0.1}, ToneCase{false, 60, 3, 4, 0, 0.2}, ToneCase{false, 150, 2, 4, 200, 0.15}}) {
    const Scan scan = tonePage(c);
    Recipe recipe;
    recipe.edges.mode = EdgeMode::Outline;
    StageCache cache;
    const PipelineOutput out = runPipeline(scan, recipe, cache, {}, {});
    const std::string what = "closed " + std::to_string(c.closed) + ", contrast " + std::to_string(c.contrast) +
                             ", blur " + std::to_string(c.blurPx) + ", fade " + std::to_string(c.fadePx);
    ASSERT_FALSE(out.error) << what << ": " << out.error->message;
    std::vector<std::vector<Vec2>> curves;
    for (const TracedCurve& curve : out.faired->curves) {
      curves.emplace_back();
      for (const CurveSample& s : sampleByArcLength(curve.faired, 1000))
        curves.back().push_back(out.frame.pointToImage(s.point));
    }
    const test::LineScore score = test::scoreLines(toneTruth(c), curves, kToneWidth, kToneHeight);
    EXPECT_GE(score.covered, 0.97) << what;
    EXPECT_LE(score.falsePx, 10.0) << what;
    EXPECT_LT(score.rmsPx, c.curvePx) << what;
  }
}

/// The page's own paper is the same on both sides of a drawn tone that leaves it: a bent edge is no fold.
TEST(ToneEdges, AreNotTakenForFoldsWhereTheyBend) {
  const Scan scan = tonePage({false, 60, 1, 4, 0, 0});
  const auto thresholds = findThresholds(scan.grey, {}, {}, {});
  ASSERT_TRUE(thresholds);
  EXPECT_TRUE(thresholds->paper.folds.empty());
}

}  // namespace
}  // namespace batten
