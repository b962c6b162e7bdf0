// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/image/threshold/region_values.h"
#include "tests/support/stress_page.h"
#include "tests/unit/image/known_ink_page.h"

namespace batten {
namespace {

using test::KnownInkPage;
using test::thresholded;
using test::wrongPixels;

/// A ring of 8 px pen width and a filled disc on paper that falls off across the page, blurred as a scanner does.
struct Tones {
  double dark, fall;  // of the paper
  double contrast, noise;
};

KnownInkPage drawPage(int width, int height, const Tones& tones) {
  constexpr unsigned kSeed = 4;
  const auto& [dark, fall, contrast, noise] = tones;
  KnownInkPage page{GreyImage(width, height), BitImage(width, height), BitImage(width, height)};
  std::mt19937 random(kSeed);
  std::normal_distribution<double> grain(0.0, noise > 0.0 ? noise : 1.0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width, v = (y + 0.5) / height;
      const double paper = dark + fall * (1.0 - u * u) * (0.4 + 0.6 * v);
      const double ring = std::fabs(std::hypot(x + 0.5 - 0.35 * width, y + 0.5 - 0.5 * height) - 0.3 * height) - 4.0;
      const double disc = std::hypot(x + 0.5 - 0.82 * width, y + 0.5 - 0.4 * height) - 0.12 * height;
      const double distance = std::min(ring, disc);
      const double cover = 0.5 * std::erfc(distance / (std::sqrt(2.0) * 1.0));
      const double level = paper - contrast * cover + (noise > 0.0 ? grain(random) : 0.0);
      page.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * 257.0));
      page.truth.set(x, y, distance < 0.0);
      page.nearEdge.set(x, y, std::fabs(distance) < 1.5);
    }
  }
  return page;
}

TEST(Thresholds, FindTheDrawingOnCleanGradatedAndDarkNoisyPages) {
  const KnownInkPage clean = drawPage(640, 480, {255.0, 0.0, 235.0, 0.0});
  EXPECT_EQ(wrongPixels(clean, thresholded(clean.grey, {}, {})), 0);
  const KnownInkPage scan = drawPage(640, 480, {150.0, 80.0, 110.0, 4.0});
  EXPECT_EQ(wrongPixels(scan, thresholded(scan.grey, {}, {})), 0);
  const KnownInkPage dark = drawPage(640, 480, {50.0, 130.0, 40.0, 4.0});
  EXPECT_LE(wrongPixels(dark, thresholded(dark.grey, {}, {})), 20);
}

TEST(Thresholds, FindTheDrawingOnLargePagesToo) {
  const KnownInkPage page = drawPage(2101, 1507, {120.0, 90.0, 80.0, 4.0});
  EXPECT_LE(wrongPixels(page, thresholded(page.grey, {}, {})), 20);
}

TEST(Thresholds, PaperFollowsTheGradation) {
  const KnownInkPage page = drawPage(640, 480, {80.0, 120.0, 60.0, 0.0});
  const auto found = findThresholds(page.grey, {}, {}, {});
  for (const int y : {40, 240, 440}) {
    for (const int x : {20, 200, 480, 620}) {
      const double u = (x + 0.5) / 640, v = (y + 0.5) / 480;
      EXPECT_NEAR(found->paper.at(x + 0.5, y + 0.5), 80.0 + 120.0 * (1.0 - u * u) * (0.4 + 0.6 * v), 4.0);
    }
  }
}

// Toned paper with lines of a pencil and white chalk, which is brighter than the paper by more than the lines are
// darker: the chalk is no paper, and the paper around it no ink.
TEST(Thresholds, ChalkOnTonedPaperIsNoPaper) {
  constexpr int kTonedWidth = 640, kTonedHeight = 480;
  const auto distance = [](double x, double y) {
    const double bulb = std::fabs(std::hypot(x - 420.0, y - 200.0) - 110.0);
    return std::min(bulb, std::fabs(std::hypot(x - 150.0, y - 260.0) - 90.0)) - 2.0;
  };
  const auto isChalk = [](double x, double y) { return std::hypot(x - 420.0, y - 200.0) < 104.0; };
  const auto paper = [&](double x, double y) {
    const double strokes = std::sin(0.21 * x + 0.4 * std::sin(0.13 * y)) + std::sin(0.17 * y - 0.1 * x);
    const double chalk = isChalk(x, y) ? 55.0 * std::clamp(0.6 + 0.8 * strokes, 0.0, 1.0) : 0.0;
    return 145.0 - 0.03 * x - 0.02 * y + chalk;
  };
  std::vector<float> coverage;
  for (int y = 0; y < kTonedHeight; ++y)
    for (int x = 0; x < kTonedWidth; ++x)
      coverage.push_back(static_cast<float>(std::clamp(0.5 - distance(x + 0.5, y + 0.5), 0.0, 1.0)));
  const Scan scan = test::renderStress(coverage, kTonedWidth, kTonedHeight, paper, {35.0, 2.0, 0.8}, 5);
  const auto thresholds = findThresholds(scan.grey, {}, {}, {});
  ASSERT_TRUE(thresholds && thresholds->foundLine);
  const BitImage ink = *binarize(scan.grey, *thresholds, {}, {});
  int seen = 0, drawn = 0, astray = 0;
  for (int y = 0; y < kTonedHeight; ++y) {
    for (int x = 0; x < kTonedWidth; ++x) {
      const double d = distance(x + 0.5, y + 0.5);
      if (d < -1.0) ++drawn;
      if (d < -1.0 && ink.at(x, y)) ++seen;
      if (d > 2.0 && !isChalk(x + 0.5, y + 0.5) && ink.at(x, y)) ++astray;
    }
  }
  EXPECT_GT(seen, 0.95 * drawn);
  EXPECT_LE(astray, 12);
}

// A black frame around white paper in an area that is hatched all over: there the hatching is what most of the page
// shows, and the even paper within the frame is what it was drawn on.
TEST(Thresholds, EvenPaperBrighterThanHatchingIsPaper) {
  constexpr int kHatchedWidth = 900, kHatchedHeight = 700;
  const auto beyond = [](double x, double y, double halfWidth, double halfHeight) {
    return std::max(std::fabs(x - 470.0) - halfWidth, std::fabs(y - 360.0) - halfHeight);
  };
  const auto isPaper = [&](double x, double y) { return beyond(x, y, 150.0, 110.0) < 0.0; };
  const auto tone = [&](double x, double y) {
    if (isPaper(x, y)) return 240.0;
    const double hatch = std::sin(0.9 * x + 1.3 * y + 2.0 * std::sin(0.031 * x - 0.02 * y)) +
                         std::sin(1.1 * x - 0.7 * y + 3.0 * std::sin(0.017 * y)) + std::sin(0.05 * x + 0.04 * y);
    return 100.0 + 14.0 * hatch;
  };
  const auto frame = [&](double x, double y) {
    return std::max(beyond(x, y, 180.0, 140.0), -beyond(x, y, 150.0, 110.0));
  };
  std::vector<float> coverage;
  for (int y = 0; y < kHatchedHeight; ++y)
    for (int x = 0; x < kHatchedWidth; ++x)
      coverage.push_back(static_cast<float>(std::clamp(0.5 - frame(x + 0.5, y + 0.5), 0.0, 1.0)));
  const Scan scan = test::renderStress(coverage, kHatchedWidth, kHatchedHeight, tone, {85.0, 2.0, 0.8}, 5);
  const auto thresholds = findThresholds(scan.grey, {}, {}, {});
  ASSERT_TRUE(thresholds && thresholds->foundLine);
  EXPECT_NEAR(thresholds->paper.at(470.0, 360.0), 240.0, 10.0);
  const BitImage ink = *binarize(scan.grey, *thresholds, {}, {});
  int seen = 0, drawn = 0;
  for (int y = 0; y < kHatchedHeight; ++y) {
    for (int x = 0; x < kHatchedWidth; ++x) {
      if (frame(x + 0.5, y + 0.5) > -2.0) continue;
      ++drawn;
      seen += ink.at(x, y) ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 0.97 * drawn);
}

TEST(Thresholds, FlatPagesHoldNothing) {
  for (const bool flatten : {true, false}) {
    for (const std::uint16_t fill : {std::uint16_t{0}, std::uint16_t{30000}, std::uint16_t{0xffff}}) {
      const GreyImage page(300, 200, fill);
      const auto found = findThresholds(page, {flatten}, {}, {});
      EXPECT_FALSE(found->foundLine);
      EXPECT_FALSE(found->note.empty());
      EXPECT_EQ(binarize(page, *found, {}, {})->count(), 0);
    }
    const KnownInkPage noise = drawPage(400, 300, {180.0, 40.0, 0.0, 6.0});
    EXPECT_FALSE(findThresholds(noise.grey, {flatten}, {}, {})->foundLine);
    EXPECT_EQ(thresholded(noise.grey, {flatten}, {}).count(), 0);
  }
}

TEST(Thresholds, TinyPicturesDoNotFail) {
  for (const int width : {1, 2, 3, 7, 9}) {
    for (const int height : {1, 2, 5, 8}) {
      GreyImage page(width, height);
      page.row(height / 2)[width / 2] = 0;
      for (const bool flatten : {true, false}) {
        const auto found = findThresholds(page, {flatten}, {}, {});
        ASSERT_TRUE(found.has_value());
        EXPECT_TRUE(binarize(page, *found, {}, {}).has_value());
      }
    }
  }
}

TEST(Thresholds, DoNotDependOnThreads) {
  const KnownInkPage page = drawPage(900, 700, {100.0, 100.0, 50.0, 4.0});
  ThresholdParams params;
  params.reach = 0.5;
  EXPECT_EQ(thresholded(page.grey, {}, params, 1), thresholded(page.grey, {}, params, 4));
}

TEST(Thresholds, OtsuParEachRegionAndFillsEmptyOnes) {
  const KnownInkPage page = drawPage(640, 480, {210.0, 20.0, 150.0, 3.0});
  const auto found = findThresholds(page.grey, {false}, {}, {});
  EXPECT_TRUE(found->paper.isEmpty());
  EXPECT_TRUE(found->foundLine);
  EXPECT_FALSE(found->measured[7]);
  EXPECT_EQ(wrongPixels(page, thresholded(page.grey, {false}, {})), 0);
}

TEST(Thresholds, TheUsersLevelsAct) {
  GreyImage page(160, 160, static_cast<std::uint16_t>(200 * 257));
  for (int y = 0; y < 160; ++y) {
    for (int x = 80; x < 160; ++x) page.row(y)[x] = static_cast<std::uint16_t>(100 * 257);
  }
  ThresholdParams params;
  params.mode = ThresholdMode::Manual;
  params.manualLevel = 50.0;
  params.interpolate = false;
  params.grid[7] = 150.0;  // upper right corner
  params.grid[0] = 150.0;  // upper left: the paper is brighter than that
  const BitImage ink = thresholded(page, {false}, params);
  EXPECT_EQ(ink.count(), 20 * 20);
  EXPECT_TRUE(ink.at(150, 10));
  const auto found = findThresholds(page, {false}, params, {});
  EXPECT_EQ(found->level[7], 150.0);
  EXPECT_EQ(found->level[6], 50.0);
  params.manualLevel = 256.0;
  EXPECT_EQ(findThresholds(page, {}, params, {}).error().code, ErrorCode::BadParameter);
}

TEST(Thresholds, StrengthAsksForDarkerInk) {
  const KnownInkPage page = drawPage(640, 480, {200.0, 20.0, 100.0, 2.0});
  ThresholdParams weak, strong;
  weak.strength = 0.6;
  strong.strength = 1.6;
  EXPECT_GT(thresholded(page.grey, {}, weak).count(), thresholded(page.grey, {}, {}).count());
  EXPECT_LT(thresholded(page.grey, {}, strong).count(), thresholded(page.grey, {}, {}).count());
}

TEST(Thresholds, HistogramsCountEveryPixelOnce) {
  const KnownInkPage page = drawPage(643, 481, {100.0, 100.0, 50.0, 4.0});
  std::uint64_t total = 0;
  for (int region = 0; region < kRegions; ++region) {
    for (const auto n : regionHistogram(page.grey, region)) total += n;
  }
  EXPECT_EQ(total, 643u * 481u);
}

}  // namespace
}  // namespace batten
