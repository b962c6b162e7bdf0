// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/curve/arc_length.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/brush_ink.h"
#include "tests/support/contour_shapes.h"

namespace batten {
namespace {

constexpr double kLeft = 100.0, kRight = 150.0, kTop = 60.0, kBottom = 540.0;  // px, of the stem of a letter
constexpr double kFrayPx = 3.0, kBristlePx = 9.0;                              // depth and length of what frays it
constexpr double kTolerancePx = 4.2;  // of a detail of 0.8 for ink of that width

// A stem whose sides bristles have frayed; `dry`: its ink is uneven too.
Scan stem(bool dry) {
  std::mt19937 random(3);
  std::vector<double> side[2];
  for (auto& offsets : side)
    for (int i = 0; i < 60; ++i) offsets.push_back(kFrayPx * (static_cast<double>(random() % 1000) / 500.0 - 1.0));
  const auto fray = [&](int which, double y) {
    const double at = std::max(0.0, (y - kTop) / kBristlePx);
    const auto i = static_cast<std::size_t>(at);
    const double f = at - std::floor(at);
    return i + 1 < side[which].size() ? (1.0 - f) * side[which][i] + f * side[which][i + 1] : 0.0;
  };
  test::RenderSettings s;
  s.width = 260;
  s.height = 600;
  s.blurPx = 0.8;
  s.noise = 2.0;
  Scan scan;
  scan.grey = test::renderShape(
      [&](double x, double y) { return y > kTop && y < kBottom && x > kLeft + fray(0, y) && x < kRight + fray(1, y); },
      s);
  if (dry) test::dryInk(scan.grey, test::thresholdMask(scan.grey, 150.0), 35.0);
  return scan;
}

TracedCurve outlineOf(const Scan& scan, bool smooths) {
  Recipe recipe;
  recipe.edges.mode = EdgeMode::Outline;
  recipe.corners.automatic = false;
  recipe.construct.smoothRagged = smooths;
  StageCache cache;
  const PipelineOutput out = runPipeline(scan, recipe, cache, {}, {});
  if (out.error || !out.faired || out.faired->curves.size() != 1) throw std::runtime_error("not one curve");
  return out.faired->curves.front();
}

// Farthest from the sides of the stem, of what is not near its ends.
double farthestOfSides(const TracedCurve& curve, const Scan& scan) {
  StageCache cache;
  const PipelineOutput out = runPipeline(scan, {}, cache, {}, {});
  double farthest = 0.0;
  for (const CurveSample& s : sampleByArcLength(curve.faired, 2000)) {
    const Vec2 at = out.frame.pointToImage(s.point);
    if (at.y() < kTop + 40.0 || at.y() > kBottom - 40.0) continue;
    farthest = std::max(farthest, std::min(std::fabs(at.x() - kLeft), std::fabs(at.x() - kRight)));
  }
  return farthest;
}

TEST(RaggedOutlines, TheStemOfADryBrushIsDrawnAsItWasMeant) {
  const Scan scan = stem(true);
  const TracedCurve meant = outlineOf(scan, true), followed = outlineOf(scan, false);
  EXPECT_LT(3 * meant.faired.controlPointCount(), followed.faired.controlPointCount());
  EXPECT_LT(farthestOfSides(meant, scan), kFrayPx + kTolerancePx);
  EXPECT_NE(meant.construct.note.find("construct.smooth_ragged"), std::string::npos) << meant.construct.note;
}

// The same border in solid ink was cut or drawn so.
TEST(RaggedOutlines, SolidInkIsFollowed) {
  const Scan scan = stem(false);
  EXPECT_EQ(outlineOf(scan, true).faired, outlineOf(scan, false).faired);
}

}  // namespace
}  // namespace batten
