// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/image/page_preparation.h"
#include "core/image/threshold/binarize.h"
#include "tests/support/colour_page.h"

namespace batten {
namespace {

using test::ColourPage;
using test::InkLayer;
using test::lineCoverage;
using test::renderColourPage;

constexpr int kColourWidth = 600, kColourHeight = 420;
constexpr std::array<double, 3> kYellow{0.99, 0.95, 0.35}, kRed{0.9, 0.3, 0.3}, kBlack{0.1, 0.1, 0.1};

std::vector<float> stroke(const Vec2& a, const Vec2& b, double widthPx) {
  return lineCoverage(kColourWidth, kColourHeight, a, b, widthPx);
}

std::vector<float> disc(const Vec2& centre, double radius) {
  std::vector<float> coverage;
  for (int y = 0; y < kColourHeight; ++y) {
    for (int x = 0; x < kColourWidth; ++x) {
      const double away = (Vec2(x + 0.5, y + 0.5) - centre).norm();
      coverage.push_back(static_cast<float>(std::clamp(radius - away + 0.5, 0.0, 1.0)));
    }
  }
  return coverage;
}

std::vector<float> ring(const Vec2& centre, double radius, double widthPx) {
  std::vector<float> outer = disc(centre, radius + 0.5 * widthPx), inner = disc(centre, radius - 0.5 * widthPx);
  for (std::size_t i = 0; i < outer.size(); ++i) outer[i] -= inner[i];
  return outer;
}

ColourPage page(double noise = 2.0) {
  ColourPage p;
  p.width = kColourWidth;
  p.height = kColourHeight;
  p.noise = noise;
  return p;
}

/// A lamp's light: warm at one side, and darker at the other.
ColourPage warmPage() {
  ColourPage p = page(3.0);
  p.paperLeft = {240, 215, 180};
  p.paperRight = {170, 140, 105};
  return p;
}

PreparedPage prepared(const Scan& scan, ColourUse use = ColourUse::Darkest, int threads = 0) {
  RunContext context;
  context.threads = threads;
  PreparationParams params;
  params.colour = use;
  return *preparePage(scan, params, context);
}

BitImage inkOf(const Scan& scan, ColourUse use) {
  const PreparedPage page = prepared(scan, use);
  const GreyImage& grey = page.grey ? *page.grey : scan.grey;
  const auto thresholds = findThresholds(grey, {}, {}, {});
  return *binarize(grey, *thresholds, {}, {});
}

TEST(ColouredInk, FindsYellowMarkerThatTheGreyMisses) {
  const auto marker = stroke({60, 100}, {540, 160}, 14), pen = stroke({60, 300}, {540, 260}, 5);
  for (const ColourPage& paper : {page(), warmPage()}) {
    const Scan scan = renderColourPage(paper, {{marker, kYellow}, {pen, kBlack}});
    EXPECT_GT(test::shareFound(marker, inkOf(scan, ColourUse::Darkest)), 0.97);
    EXPECT_LT(test::shareFound(marker, inkOf(scan, ColourUse::Grey)), 0.7);
    EXPECT_GT(test::shareFound(pen, inkOf(scan, ColourUse::Darkest)), 0.99);
  }
}

TEST(ColouredInk, KeepsTheWidthOfAStroke) {
  const auto marker = stroke({60, 100}, {540, 100}, 14);
  const Scan scan = renderColourPage(page(), {{marker, kYellow}});
  const BitImage ink = inkOf(scan, ColourUse::Darkest);
  int sum = 0;
  for (int x = 100; x < 500; ++x) {
    for (int y = 60; y < 140; ++y) sum += ink.at(x, y) ? 1 : 0;
  }
  EXPECT_NEAR(sum / 400.0, 14.0, 0.6);
}

TEST(ColouredInk, LeavesAPageOfBlackInkAsItIs) {
  const auto pen = stroke({60, 300}, {540, 60}, 5), pencil = stroke({60, 60}, {540, 300}, 3);
  for (const ColourPage& paper : {page(), warmPage(), page(8.0)}) {
    const Scan scan = renderColourPage(paper, {{pen, kBlack}, {pencil, {0.6, 0.6, 0.6}}});
    EXPECT_TRUE(prepared(scan).isUntouched());
  }
}

TEST(ColouredInk, LeavesAPageWithoutColoursAsItIs) {
  const auto pen = stroke({60, 300}, {540, 60}, 5);
  Scan scan = renderColourPage(page(), {{pen, kBlack}});
  scan.colour = ColourImage();
  EXPECT_TRUE(prepared(scan).isUntouched());
  EXPECT_EQ(prepared(scan).colouredShare, 0.0);
}

TEST(ColouredInk, LeavesAnAreaColouredInWithinItsOutline) {
  const Scan scan = renderColourPage(page(), {{disc({300, 210}, 120), kYellow}, {ring({300, 210}, 120, 6), kBlack}});
  EXPECT_TRUE(prepared(scan).isUntouched());
}

// Light of another colour in a corner of the page, as of a lamp or a shadow, has no edge as ink has.
TEST(ColouredInk, ATintThatFadesInIsNoInk) {
  std::vector<float> fading;
  for (int y = 0; y < kColourHeight; ++y) {
    for (int x = 0; x < kColourWidth; ++x) {
      const double away = std::hypot(x - 1.0 * kColourWidth, y - 1.0 * kColourHeight);
      fading.push_back(static_cast<float>(std::clamp(1.0 - away / 260.0, 0.0, 1.0)));
    }
  }
  constexpr std::array<double, 3> kBrown{0.8, 0.65, 0.4};
  const auto marker = stroke({60, 100}, {540, 160}, 14);
  const Scan scan = renderColourPage(page(), {{fading, kBrown}, {marker, kYellow}});
  const PreparedPage made = prepared(scan);
  ASSERT_TRUE(made.grey);
  int darkened = 0;
  for (int y = 250; y < kColourHeight; ++y) {
    for (int x = 350; x < kColourWidth; ++x) darkened += made.grey->row(y)[x] != scan.grey.row(y)[x] ? 1 : 0;
  }
  EXPECT_EQ(darkened, 0);
  EXPECT_GT(test::shareFound(marker, inkOf(scan, ColourUse::Darkest)), 0.97);
}

// A camera's colours are noisier where a page is dark.
TEST(ColouredInk, NoiseOfTheColoursIsMeasuredByPlace) {
  const auto marker = stroke({60, 100}, {420, 160}, 14);
  Scan scan = renderColourPage(page(), {{marker, kYellow}});
  constexpr int kNoisyFrom = 460, kGrainPx = 4;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 14.0);
  for (int y = 0; y < kColourHeight; y += kGrainPx) {
    for (int x = kNoisyFrom; x < kColourWidth; x += kGrainPx) {
      const int more = static_cast<int>(std::lround(noise(random)));
      for (int j = y; j < y + kGrainPx; ++j) {
        for (int i = x; i < x + kGrainPx; ++i) {
          Rgb8& pixel = scan.colour.row(j)[i];
          pixel.red = static_cast<std::uint8_t>(std::clamp(pixel.red + more, 0, 255));
          pixel.blue = static_cast<std::uint8_t>(std::clamp(pixel.blue - more, 0, 255));
        }
      }
    }
  }
  const PreparedPage made = prepared(scan);
  ASSERT_TRUE(made.grey);
  int darkened = 0;
  for (int y = 0; y < kColourHeight; ++y) {
    for (int x = kNoisyFrom; x < kColourWidth; ++x) darkened += made.grey->row(y)[x] != scan.grey.row(y)[x] ? 1 : 0;
  }
  EXPECT_EQ(darkened, 0);
  EXPECT_GT(test::shareFound(marker, inkOf(scan, ColourUse::Darkest)), 0.97);
}

TEST(ColouredInk, TouchesOnlyTheSurroundingsOfColouredInk) {
  const auto marker = stroke({60, 100}, {540, 160}, 14), pen = stroke({60, 300}, {540, 260}, 5);
  const Scan scan = renderColourPage(warmPage(), {{marker, kYellow}, {pen, kBlack}});
  const PreparedPage result = prepared(scan);
  ASSERT_FALSE(result.isUntouched());
  const auto around = stroke({60, 100}, {540, 160}, 14 + 2 * 7);
  for (int y = 0; y < kColourHeight; ++y) {
    for (int x = 0; x < kColourWidth; ++x) {
      if (around[std::ptrdiff_t{y} * kColourWidth + x] == 0.0f) {
        ASSERT_EQ(result.grey->row(y)[x], scan.grey.row(y)[x]) << x << ", " << y;
      }
    }
  }
}

TEST(ColouredInk, IsTheSameWithAnyNumberOfThreads) {
  const Scan scan = renderColourPage(warmPage(), {{stroke({60, 100}, {540, 160}, 14), kYellow}});
  EXPECT_EQ(prepared(scan, ColourUse::Darkest, 1).grey, prepared(scan, ColourUse::Darkest, 4).grey);
}

TEST(ColouredInk, RedPenLosesNothing) {
  const auto pen = stroke({60, 300}, {540, 60}, 4);
  const Scan scan = renderColourPage(page(), {{pen, kRed}});
  EXPECT_GT(test::shareFound(pen, inkOf(scan, ColourUse::Darkest)), 0.99);
}

}  // namespace
}  // namespace batten
