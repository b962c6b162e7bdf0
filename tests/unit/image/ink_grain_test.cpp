// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/ink_grain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/image/threshold/binarize.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {
namespace {

constexpr int kStrokes = 6;
constexpr double kStrokePx = 20.0;

bool isInStroke(int x, int y) { return x >= 40 && x < 560 && (y % 70) >= 30 && (y % 70) < 30 + kStrokePx; }

BitImage strokes(double tornShare) {
  BitImage ink(600, 70 * kStrokes);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) ink.set(x, y, isInStroke(x, y) && share(random) >= tornShare);
  }
  return ink;
}

/// Strokes on white paper of which every grain of about 3 px takes a part of the pigment.
GreyImage scanned(double grainDepth) {
  GreyImage page(600, 70 * kStrokes);
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> tooth((page.width / 3 + 1) * (page.height / 3 + 1));
  for (double& t : tooth) t = normal(random);
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      const double grain = tooth[(y / 3) * (page.width / 3 + 1) + x / 3];
      const double cover = isInStroke(x, y) ? std::clamp(0.6 + grainDepth * grain, 0.0, 1.0) : 0.0;
      const double level = 235.0 - 150.0 * cover + 2.0 * normal(random);
      page.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * 257.0));
    }
  }
  return page;
}

TEST(InkGrain, WholeStrokesHaveTheirWidthAndNoGrain) {
  const InkGrain grain = measureGrain(strokes(0.0), {});
  EXPECT_NEAR(grain.widthPx, kStrokePx, 0.05 * kStrokePx);
  EXPECT_EQ(grain.perWidth, 0.0);
}

TEST(InkGrain, HolesAreCountedPerWidthOfStroke) {
  const InkGrain grain = measureGrain(strokes(0.02), {});
  EXPECT_LT(grain.widthPx, 0.9 * kStrokePx);
  EXPECT_GT(grain.perWidth, 0.5);
}

TEST(InkGrain, APageWithoutInkHasNone) {
  const InkGrain grain = measureGrain(BitImage(50, 40), {});
  EXPECT_EQ(grain.widthPx, 0.0);
  EXPECT_EQ(grain.perWidth, 0.0);
}

TEST(InkGrain, TornInkIsSmoothedMoreAndAskedForLessContrast) {
  const RegionThresholds pen = *findThresholds(scanned(0.0), {}, {}, {});
  const RegionThresholds pencil = *findThresholds(scanned(0.35), {}, {}, {});
  EXPECT_EQ(pen.halfLevelShare, 1.0);
  EXPECT_EQ(pen.smoothingPx, 1.0);
  const InkGrain grain =
      measureGrain(*binarize(scanned(0.35), pencil, {.reach = 1.0, .speckArea = 0, .holeArea = 0}, {}), {});
  EXPECT_LT(pencil.halfLevelShare, 1.0) << "of " << grain.widthPx << " px: " << grain.perWidth;
  EXPECT_GT(pencil.smoothingPx, pen.smoothingPx);
}

}  // namespace
}  // namespace batten
