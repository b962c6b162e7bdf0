// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/whole_ink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/threshold/binarize.h"

namespace batten {
namespace {

constexpr int kGrainPx = 3, kWholeWidth = 900, kWholeHeight = 1400, kCaptionFrom = 1000;
constexpr double kRingPx = 4.0, kPenPx = 2.4;  // radius of the middle of the line

/// Middles of the letters o of a caption.
std::vector<Vec2> ringCentres() {
  std::vector<Vec2> centres;
  for (int y = kCaptionFrom + 40; y < kWholeHeight - 40; y += 40)
    for (int x = 40; x < kWholeWidth - 40; x += 15) centres.emplace_back(x + 0.3, y + 0.6);
  return centres;
}

/// Strokes of a pencil that the grain tears, above a caption by a fine pen.
GreyImage pencilAboveCaption() {
  GreyImage page(kWholeWidth, kWholeHeight);
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> cover(std::size_t{kWholeWidth} * kWholeHeight, 0.0);
  std::vector<double> tooth((kWholeWidth / kGrainPx + 1) * (kWholeHeight / kGrainPx + 1));
  for (double& t : tooth) t = normal(random);
  for (int y = 0; y < kCaptionFrom; ++y)
    for (int x = 40; x < kWholeWidth - 40; ++x)
      if (y % 70 >= 30 && y % 70 < 50)
        cover[y * kWholeWidth + x] =
            std::clamp(0.6 + 0.35 * tooth[(y / kGrainPx) * (kWholeWidth / kGrainPx + 1) + x / kGrainPx], 0.0, 1.0);
  for (const Vec2& centre : ringCentres()) {
    for (int y = static_cast<int>(centre.y()) - 8; y < centre.y() + 8; ++y)
      for (int x = static_cast<int>(centre.x()) - 8; x < centre.x() + 8; ++x) {
        const double inside = 0.5 * kPenPx - std::abs((Vec2(x + 0.5, y + 0.5) - centre).norm() - kRingPx);
        cover[y * kWholeWidth + x] = std::clamp(inside / 1.6 + 0.5, 0.0, 1.0);
      }
  }
  for (int y = 0; y < kWholeHeight; ++y)
    for (int x = 0; x < kWholeWidth; ++x) {
      const double level = 235.0 - 150.0 * cover[y * kWholeWidth + x] + 2.0 * normal(random);
      page.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * 257.0));
    }
  return page;
}

TEST(WholeInk, SmallLettersByPenStayOpenOnAPageOfTornPencil) {
  const GreyImage page = pencilAboveCaption();
  const auto thresholds = findThresholds(page, {}, {}, {});
  ASSERT_TRUE(thresholds);
  ASSERT_LT(thresholds->halfLevelShare, 1.0) << "the page is to be torn";
  const auto ink = binarize(page, *thresholds, {}, {});
  ASSERT_TRUE(ink);
  const std::vector<Vec2> centres = ringCentres();
  int open = 0;
  double area = 0.0;
  for (const Vec2& centre : centres) {
    open += ink->at(static_cast<int>(centre.x()), static_cast<int>(centre.y())) ? 0 : 1;
    for (int y = -7; y <= 7; ++y)
      for (int x = -7; x <= 7; ++x)
        area += ink->at(static_cast<int>(centre.x()) + x, static_cast<int>(centre.y()) + y) ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(centres.size());
  EXPECT_GE(open, 0.99 * count);
  // The pencil is paler, so its level shows more of the pen's blurred edge.
  EXPECT_LT(area / count, 1.4 * 2.0 * std::numbers::pi * kRingPx * kPenPx);
}

TEST(WholeInk, TornPencilStaysAsSmoothAsWithoutACaption) {
  const GreyImage page = pencilAboveCaption();
  auto thresholds = findThresholds(page, {}, {}, {});
  ASSERT_TRUE(thresholds && thresholds->finer);
  const auto ink = binarize(page, *thresholds, {}, {});
  thresholds->finer.reset();
  const auto smoothed = binarize(page, *thresholds, {}, {});
  ASSERT_TRUE(ink && smoothed);
  for (int y = 0; y < kCaptionFrom; ++y)
    EXPECT_TRUE(std::equal(ink->row(y), ink->row(y) + ink->wordsPerRow, smoothed->row(y))) << "row " << y;
}

}  // namespace
}  // namespace batten
