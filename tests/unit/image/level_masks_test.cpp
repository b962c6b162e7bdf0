// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/level_masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/image/plane.h"
#include "core/image/threshold/region_surface.h"

namespace batten {
namespace {

/// Lines and dust on paper that falls off, with noise.
GreyImage drawnPage(int width, int height, double noise, unsigned seed) {
  GreyImage grey(width, height);
  std::mt19937 random(seed);
  std::normal_distribution<double> grain(0.0, 1.0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double paper = 235.0 - 60.0 * x / width;
      const double away = std::fabs(y - 0.5 * height - 0.3 * height * std::sin(0.01 * x));
      const bool isFaint = (x / 50) % 3 == 0, isDust = random() % 3000 == 0;
      const double ink = away < 3.0 ? (isFaint ? 25.0 : 120.0) : isDust ? 90.0 : 0.0;
      const double level = std::clamp(paper - ink + noise * grain(random), 0.0, 255.0);
      grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(257.0 * level));
    }
  }
  return grey;
}

/// Every pixel of the page, one by one, by the definition.
LevelMasks everyPixel(const GreyImage& image, const RegionThresholds& t, const ThresholdParams& params) {
  const int width = image.width, height = image.height;
  LevelMasks masks{BitImage(width, height), BitImage(width, height), BitImage(width, height)};
  const RegionSurface contrast(t.contrast, width, height, params.interpolate),
      certain(t.certain, width, height, params.interpolate);
  const double variance = t.smoothingPx * t.smoothingPx;
  const Plane grey =
      smooth(shrinkGrey(image, 1, {}), gaussianKernel(variance > 0.0 ? std::max(variance, 0.51) : 0.0), {});
  const auto reach = static_cast<float>(params.reach > 0.0 ? params.reach : 0.4);
  std::vector<float> plain(width), deep(width);
  for (int y = 0; y < height; ++y) {
    contrast.fillRow(y, plain.data());
    certain.fillRow(y, deep.data());
    for (int x = 0; x < width; ++x) {
      float paper = 255.0f;
      if (!t.paper.isEmpty()) {
        const int cell = t.paper.cellPx, half = cell / 2, last = t.paper.columns - 1;
        const double v = std::clamp((y + 0.5) / cell - 0.5, 0.0, t.paper.rows - 1.0);
        const int top = static_cast<int>(v), below = std::min(top + 1, t.paper.rows - 1);
        const auto column = [&](int c) {
          const float a = t.paper.grey[std::ptrdiff_t{top} * t.paper.columns + c];
          return a + static_cast<float>(v - top) * (t.paper.grey[std::ptrdiff_t{below} * t.paper.columns + c] - a);
        };
        const int c = std::min((x - half) / cell, last);
        const float left = column(c),
                    slope = (column(std::min(c + 1, last)) - left) * (1.0f / static_cast<float>(cell));
        paper = x < half ? column(0) : left + slope * (static_cast<float>(x - c * cell - half) + 0.5f);
      }
      const float here = grey.row(y)[x];
      const float weaker = plain[x] < 0.0f ? reach * plain[x] : plain[x];
      const float faint = std::max(plain[x], std::min(weaker, static_cast<float>(t.faintLimit)));
      masks.ink.set(x, y, here < paper + plain[x]);
      masks.certain->set(x, y, here < paper + deep[x]);
      masks.faint->set(x, y, here < paper + faint);
    }
  }
  return masks;
}

void expectEveryPixelsMasks(const GreyImage& grey, const PaperParams& paper, const ThresholdParams& params) {
  const auto thresholds = findThresholds(grey, paper, params, {});
  ASSERT_TRUE(thresholds);
  const LevelMasks expected = everyPixel(grey, *thresholds, params);
  for (const int threads : {1, 3}) {
    RunContext context;
    context.threads = threads;
    const LevelMasks masks = compareWithLevels(grey, *thresholds, params, context);
    EXPECT_EQ(masks.ink, expected.ink);
    EXPECT_EQ(masks.certain, expected.certain);
    EXPECT_EQ(masks.faint, expected.faint);
  }
}

TEST(LevelMasks, AreThoseOfEveryPixelThoughPlainPaperIsPassedOver) {
  for (const auto& [width, height] : {std::pair{640, 400}, {333, 517}, {1003, 97}, {40, 9}, {2200, 1301}}) {
    SCOPED_TRACE(width);
    expectEveryPixelsMasks(drawnPage(width, height, 4.0, 1), {}, {});
  }
}

TEST(LevelMasks, AreThoseOfEveryPixelWhateverTheLevels) {
  const GreyImage grey = drawnPage(700, 450, 6.0, 2);
  ThresholdParams blocks, manual, weak;
  blocks.interpolate = false;
  manual.mode = ThresholdMode::Manual;
  manual.manualLevel = 215.0;  // within the paper
  manual.grid[20] = 255.0;
  manual.grid[21] = 0.0;
  weak.strength = 0.2;
  weak.reach = 0.05;
  for (const ThresholdParams& params : {blocks, manual, weak}) {
    expectEveryPixelsMasks(grey, {}, params);
    expectEveryPixelsMasks(grey, {.flatten = false}, params);
  }
}

TEST(LevelMasks, AreLeftOutWhereNobodyAsksForThem) {
  const GreyImage grey = drawnPage(200, 100, 2.0, 3);
  ThresholdParams params;
  params.reach = 1.0;
  params.speckArea = 0;
  const LevelMasks masks = compareWithLevels(grey, *findThresholds(grey, {}, params, {}), params, {});
  EXPECT_GT(masks.ink.count(), 0);
  EXPECT_FALSE(masks.certain);
  EXPECT_FALSE(masks.faint);
}

}  // namespace
}  // namespace batten
