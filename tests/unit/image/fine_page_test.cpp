// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/image/bits/bit_steps.h"
#include "core/image/fine_page.h"
#include "core/image/threshold/binarize.h"

namespace batten {
namespace {

constexpr int kLinePageWidth = 240, kLinePageHeight = 160;

/// [grey] Of light paper with a level line of this width, dark by `depth` in its middle, blurred by .8 px.
GreyImage pageWithLine(double widthPx, double depth, double gapFrom = -1.0, double gapTo = -1.0) {
  GreyImage grey(kLinePageWidth, kLinePageHeight);
  const auto step = [](double x) { return 0.5 * std::erfc(-x / (std::sqrt(2.0) * 0.8)); };
  for (int y = 0; y < kLinePageHeight; ++y) {
    for (int x = 0; x < kLinePageWidth; ++x) {
      const double off = std::abs(y + 0.5 - 80.3);
      double cover = step(0.5 * widthPx - off) * step(x - 30.0) * step(210.0 - x);
      if (gapTo > gapFrom) cover *= 1.0 - step(x + 0.5 - gapFrom) * step(gapTo - x - 0.5);
      // A weak texture, so that the paper has noise to measure.
      const double texture = ((x * 7 + y * 13) % 11 - 5) * 0.3;
      grey.row(y)[x] = static_cast<std::uint16_t>((230.0 + texture - depth * cover) * GreyImage::kGreyUnit);
    }
  }
  return grey;
}

BitImage inkOfLinePage(const GreyImage& grey) {
  const auto thresholds = findThresholds(grey, {}, {}, {});
  EXPECT_TRUE(thresholds);
  auto ink = binarize(grey, *thresholds, {}, {});
  EXPECT_TRUE(ink);
  return std::move(*ink);
}

/// Cubic interpolation has the values of a parabola, between the pixels and at the right places.
TEST(FinePage, EnlargesAParabolaExactly) {
  GreyImage grey(32, 24);
  const auto at = [](double x, double y) { return 20000.0 + 300.0 * x - 9.0 * x * x + 100.0 * y + 11.0 * y * y; };
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x) grey.row(y)[x] = static_cast<std::uint16_t>(at(x + 0.5, y + 0.5));
  const GreyImage fine = enlarged(grey, {});
  ASSERT_EQ(fine.width, 64);
  ASSERT_EQ(fine.height, 48);
  for (int y = 6; y < fine.height - 6; ++y)
    for (int x = 6; x < fine.width - 6; ++x)
      EXPECT_NEAR(fine.row(y)[x], at(0.5 * (x + 0.5), 0.5 * (y + 0.5)), 2.0) << x << ' ' << y;
}

TEST(FinePage, EnlargesInkPixelByPixel) {
  BitImage ink(70, 3);
  ink.set(0, 0, true);
  ink.set(33, 1, true);
  ink.set(69, 2, true);
  const BitImage fine = enlarged(ink, {});
  EXPECT_EQ(fine.count(), 12);
  EXPECT_TRUE(fine.at(66, 2) && fine.at(67, 3) && fine.at(138, 4) && fine.at(139, 5));
}

TEST(FinePage, IsMadeOfThinStrokesAlone) {
  for (const double widthPx : {2.0, 6.0}) {
    const GreyImage grey = pageWithLine(widthPx, 120.0);
    const BitImage ink = inkOfLinePage(grey);
    const auto fine = finePage(grey, ink, {}, {});
    ASSERT_TRUE(fine);
    EXPECT_EQ(fine->has_value(), widthPx < 3.0) << widthPx;
    if (!*fine) continue;
    EXPECT_EQ((*fine)->grey->width, kFineFactor * kLinePageWidth);
    // Its ink lies on the ink of the page.
    EXPECT_EQ(without((*fine)->ink, grown(enlarged(ink, {}), kFineFactor, {})).count(), 0);
    EXPECT_GT((*fine)->ink.count(), ink.count());
  }
}

TEST(FinePage, HasNoInkWhereItWasTakenOut) {
  const GreyImage grey = pageWithLine(2.0, 120.0);
  BitImage ink = inkOfLinePage(grey);
  for (int y = 0; y < kLinePageHeight; ++y)
    for (int x = 100; x < kLinePageWidth; ++x) ink.set(x, y, false);
  const auto fine = finePage(grey, ink, {}, {});
  ASSERT_TRUE(fine && *fine);
  for (int y = 0; y < kFineFactor * kLinePageHeight; ++y)
    for (int x = kFineFactor * 102; x < kFineFactor * kLinePageWidth; ++x) ASSERT_FALSE((*fine)->ink.at(x, y));
}

/// What the page's ink has away from the ink that the grey shows is kept: a faint line, say.
TEST(FinePage, KeepsInkThatOnlyThePageShows) {
  const GreyImage grey = pageWithLine(2.0, 120.0);
  BitImage ink = inkOfLinePage(grey);
  for (int x = 40; x < 200; ++x) {
    ink.set(x, 120, true);
    ink.set(x, 121, true);
  }
  const auto fine = finePage(grey, ink, {}, {});
  ASSERT_TRUE(fine && *fine);
  for (int x = 2 * 45; x < 2 * 195; ++x) EXPECT_TRUE((*fine)->ink.at(x, 2 * 120 + 1)) << x;
}

/// The size of a hole that is to be filled is one of the page.
TEST(FinePage, FillsTheHolesThatThePageFills) {
  GreyImage grey = pageWithLine(2.0, 120.0);
  const double cx = 120.3, cy = 40.4, radius = 2.9;
  for (int y = 30; y < 51; ++y) {
    for (int x = 110; x < 131; ++x) {
      const double off = std::abs(std::hypot(x + 0.5 - cx, y + 0.5 - cy) - radius);
      grey.row(y)[x] =
          static_cast<std::uint16_t>((230.0 - 120.0 * std::clamp(1.5 - off, 0.0, 1.0)) * GreyImage::kGreyUnit);
    }
  }
  for (const int holeArea : {10, 30}) {
    InkSettings settings;
    settings.threshold.holeArea = holeArea;
    const BitImage ink = *binarize(grey, *findThresholds(grey, {}, settings.threshold, {}), settings.threshold, {});
    const auto fine = finePage(grey, ink, settings, {});
    ASSERT_TRUE(fine && *fine);
    EXPECT_EQ((*fine)->ink.at(240, 80), holeArea == 30) << holeArea;
  }
}

/// The paper between the strokes of small letters is no larger than what the neighbourhood filter takes for noise on
/// the page; on the fine page it stays open.
TEST(FinePage, KeepsTheBaysOfSmallLettersOpen) {
  GreyImage grey = pageWithLine(2.0, 120.0);
  constexpr double kPitch = 4.4, kStroke = 2.0, kTop = 30.3, kHigh = 5.0;
  const auto step = [](double x) { return 0.5 * std::erfc(-x / (std::sqrt(2.0) * 0.7)); };
  for (int y = 20; y < 50; ++y) {
    for (int x = 30; x < 210; ++x) {
      const double off = std::abs(std::remainder(x + 0.5 - 40.0, kPitch));
      const double tooth = step(0.5 * kStroke - off) * step(y + 0.5 - kTop) * step(kTop + kHigh - y - 0.5);
      const double foot = step(0.5 * kStroke - std::abs(y + 0.5 - kTop - kHigh));
      grey.row(y)[x] = static_cast<std::uint16_t>((230.0 - 120.0 * std::max(tooth, foot)) * GreyImage::kGreyUnit);
    }
  }
  const BitImage ink = inkOfLinePage(grey);
  const auto fine = finePage(grey, ink, {}, {});
  ASSERT_TRUE(fine && *fine);
  int open = 0, bays = 0;
  for (double x = 40.0 + 2.5 * kPitch; x < 200.0; x += kPitch, ++bays)
    open += (*fine)->ink.at(static_cast<int>(kFineFactor * x), static_cast<int>(kFineFactor * (kTop + 1.0))) ? 0 : 1;
  EXPECT_EQ(open, bays);
}

}  // namespace
}  // namespace batten
