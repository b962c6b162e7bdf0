// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the lines of a page are brighter than its paper.
#include "core/image/threshold/bright_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace batten {
namespace {

constexpr int kPageWidth = 640, kPageHeight = 480;

/// [grey] At every pixel, and noise.
GreyImage pageOf(const std::function<double(int x, int y)>& level, double noise = 4.0) {
  GreyImage page(kPageWidth, kPageHeight);
  std::mt19937 random(3);
  std::normal_distribution<double> grain(0.0, noise);
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      const double value = std::clamp(level(x, y) + grain(random), 0.0, 255.0);
      page.row(y)[x] = static_cast<std::uint16_t>(std::lround(value * GreyImage::kGreyUnit));
    }
  }
  return page;
}

/// Rings 4 px wide.
bool isLine(int x, int y) {
  const double r = std::hypot(x - 320.0, y - 240.0);
  return r < 200.0 && std::fabs(std::remainder(r, 60.0)) < 2.0;
}

TEST(BrightLines, AreThoseOfChalkAndBlueprints) {
  EXPECT_TRUE(areLinesBrighter(pageOf([](int x, int y) { return isLine(x, y) ? 220.0 : 40.0; }), {}));
  EXPECT_TRUE(areLinesBrighter(pageOf([](int x, int y) { return isLine(x, y) ? 200.0 : 60.0 + 0.08 * x; }), {}));
}

TEST(BrightLines, AreNotThoseOfADarkExposure) {
  EXPECT_FALSE(areLinesBrighter(pageOf([](int x, int y) { return isLine(x, y) ? 20.0 : 80.0; }), {}));
  EXPECT_FALSE(areLinesBrighter(pageOf([](int x, int y) { return isLine(x, y) ? 40.0 : 230.0; }), {}));
}

/// The sheet's edge is bright against the table, but what was drawn on the sheet is darker than it.
TEST(BrightLines, AreNotTheSheetOnADarkTable) {
  const auto level = [](int x, int y) {
    const bool isSheet = x > 240 && x < 520 && y > 120 && y < 400;
    return !isSheet ? 50.0 : isLine(x, y) ? 40.0 : 235.0;
  };
  EXPECT_FALSE(areLinesBrighter(pageOf(level), {}));
}

/// Grain, a picture with tones, a few specks of dust: none of it is lines.
TEST(BrightLines, AreNotGrainTonesOrDust) {
  EXPECT_FALSE(areLinesBrighter(pageOf([](int, int) { return 60.0; }, 30.0), {}));
  const auto tones = [](int x, int y) { return 70.0 + 60.0 * std::sin(0.21 * x) * std::cos(0.17 * y); };
  EXPECT_FALSE(areLinesBrighter(pageOf(tones), {}));
  const auto dust = [](int x, int y) { return x % 160 < 3 && y % 160 < 3 ? 230.0 : 40.0; };
  EXPECT_FALSE(areLinesBrighter(pageOf(dust), {}));
  EXPECT_FALSE(areLinesBrighter(GreyImage(), {}));
}

}  // namespace
}  // namespace batten
