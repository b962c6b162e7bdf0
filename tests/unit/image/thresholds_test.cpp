// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/image/binarize.h"
#include "core/image/push_pull.h"
#include "core/image/threshold/region_values.h"
#include "tests/support/hatching_page.h"
#include "tests/support/stress_page.h"

namespace batten {
namespace {

struct Page {
  GreyImage grey;
  BitImage truth;
  BitImage nearEdge;  ///< Pixels within 1.5 px of the ideal border: either answer is right there.
};

/// A ring of 8 px pen width and a filled disc on paper that falls off across the page, blurred as a scanner does.
struct Tones {
  double dark, fall;  // of the paper
  double contrast, noise;
};

Page drawPage(int width, int height, const Tones& tones) {
  constexpr unsigned kSeed = 4;
  const auto& [dark, fall, contrast, noise] = tones;
  Page page{GreyImage(width, height), BitImage(width, height), BitImage(width, height)};
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

std::int64_t wrongPixels(const Page& page, const BitImage& ink) {
  std::int64_t wrong = 0;
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) {
      wrong += !page.nearEdge.at(x, y) && ink.at(x, y) != page.truth.at(x, y) ? 1 : 0;
    }
  }
  return wrong;
}

BitImage mask(const GreyImage& grey, const PaperParams& paper, const ThresholdParams& params, int threads = 0) {
  RunContext context;
  context.threads = threads;
  return *binarize(grey, *findThresholds(grey, paper, params, context), params, context);
}

TEST(Thresholds, FindTheDrawingOnCleanGradatedAndDarkNoisyPages) {
  const Page clean = drawPage(640, 480, {255.0, 0.0, 235.0, 0.0});
  EXPECT_EQ(wrongPixels(clean, mask(clean.grey, {}, {})), 0);
  const Page scan = drawPage(640, 480, {150.0, 80.0, 110.0, 4.0});
  EXPECT_EQ(wrongPixels(scan, mask(scan.grey, {}, {})), 0);
  const Page dark = drawPage(640, 480, {50.0, 130.0, 40.0, 4.0});
  EXPECT_LE(wrongPixels(dark, mask(dark.grey, {}, {})), 20);
}

TEST(Thresholds, FindTheDrawingOnLargePagesToo) {
  const Page page = drawPage(2101, 1507, {120.0, 90.0, 80.0, 4.0});
  EXPECT_LE(wrongPixels(page, mask(page.grey, {}, {})), 20);
}

TEST(Thresholds, PaperFollowsTheGradation) {
  const Page page = drawPage(640, 480, {80.0, 120.0, 60.0, 0.0});
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

TEST(Thresholds, FlatPagesHoldNothing) {
  for (const bool flatten : {true, false}) {
    for (const std::uint16_t fill : {std::uint16_t{0}, std::uint16_t{30000}, std::uint16_t{0xffff}}) {
      const GreyImage page(300, 200, fill);
      const auto found = findThresholds(page, {flatten}, {}, {});
      EXPECT_FALSE(found->foundLine);
      EXPECT_FALSE(found->note.empty());
      EXPECT_EQ(binarize(page, *found, {}, {})->count(), 0);
    }
    const Page noise = drawPage(400, 300, {180.0, 40.0, 0.0, 6.0});
    EXPECT_FALSE(findThresholds(noise.grey, {flatten}, {}, {})->foundLine);
    EXPECT_EQ(mask(noise.grey, {flatten}, {}).count(), 0);
  }
}

/// Lines 2.5 px wide all over the page, `spacing` px from middle to middle, at 45 degrees; with gradation and noise.
Page hatchedPage(int width, int height, double spacing, double fall, double noise) {
  Page page{GreyImage(width, height), BitImage(width, height), BitImage(width, height)};
  std::mt19937 random(7);
  std::normal_distribution<double> grain(0.0, 1.0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double across = std::remainder((x - y) / std::sqrt(2.0), spacing);
      const double distance = std::fabs(across) - 1.25;
      const double cover = 0.5 * std::erfc(distance / (std::sqrt(2.0) * 0.8));
      const double level = 235.0 - fall * x / width - 200.0 * cover + noise * grain(random);
      page.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * 257.0));
      page.truth.set(x, y, distance < 0.0);
      page.nearEdge.set(x, y, std::fabs(distance) < 0.8);
    }
  }
  return page;
}

TEST(Thresholds, FindLinesSoCloseThatNoPaperShowsBetweenThem) {
  for (const double spacing : {6.4, 8.0, 10.0}) {
    for (const double noise : {0.0, 5.0}) {
      const Page page = hatchedPage(600, 400, spacing, 20.0, noise);
      EXPECT_LT(wrongPixels(page, mask(page.grey, {}, {})), 600 * 400 / 200) << spacing << " px, noise " << noise;
    }
  }
  // As dense, but no lines: noise of a sensor and of single pixels.
  std::mt19937 random(3);
  std::normal_distribution<double> grain(128.0, 60.0);
  GreyImage page(600, 400);
  for (std::uint16_t& pixel : page.pixels)
    pixel = static_cast<std::uint16_t>(std::lround(std::clamp(grain(random), 0.0, 255.0) * 257.0));
  EXPECT_EQ(mask(page, {}, {}).count(), 0);
}

/// What is darker than 128 is found as ink, but for one pixel of `allowedOneOf`.
void expectLines(const GreyImage& page, int allowedOneOf, const std::string& what) {
  const BitImage found = mask(page, {}, {});
  int wrong = 0;
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) wrong += found.at(x, y) != (page.level(x, y) < 128.0) ? 1 : 0;
  }
  EXPECT_LT(wrong, page.width * page.height / allowedOneOf) << what;
}

TEST(Thresholds, FindRulingsGridsAndHatchingAFewPixelsApart) {
  for (const int pitch : {3, 4, 5}) {
    GreyImage page(600, 400);
    for (int y = 0; y < 400; ++y) {
      for (int x = 0; x < 600; ++x) {
        page.row(y)[x] = static_cast<std::uint16_t>((x % pitch == 1 ? 20 : 235) * 257);
      }
    }
    expectLines(page, 50, std::to_string(pitch) + " px");
  }
  // How the lines meet the cells that the paper is measured on is chance.
  for (const int first : {0, 1, 2}) {
    GreyImage across(600, 400), down(400, 600);
    for (int y = 0; y < 400; ++y) {
      for (int x = 0; x < 600; ++x)
        across.row(y)[x] = down.row(x)[y] = static_cast<std::uint16_t>((y % 3 == first ? 20 : 235) * 257);
    }
    expectLines(across, 50, "across every 3 px from " + std::to_string(first));
    expectLines(down, 50, "down every 3 px from " + std::to_string(first));
  }
  GreyImage grid(600, 400);
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 600; ++x)
      grid.row(y)[x] = static_cast<std::uint16_t>((x % 8 == 3 || y % 8 == 3 ? 20 : 235) * 257);
  }
  expectLines(grid, 12, "grid");  // four corners of every crossing are rounded
  // Of a grid this fine, the paper at the page's corner is the brightest that smoothing leaves.
  GreyImage fine(600, 400);
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 600; ++x)
      fine.row(y)[x] = static_cast<std::uint16_t>((x % 4 == 0 || y % 4 == 0 ? 20 : 235) * 257);
  }
  expectLines(fine, 6, "fine grid");
  // Hatching whose lines are 2.1 and 2.8 px apart.
  for (const int pitch : {3, 4}) {
    GreyImage hatched(600, 400);
    for (int y = 0; y < 400; ++y) {
      for (int x = 0; x < 600; ++x)
        hatched.row(y)[x] = static_cast<std::uint16_t>(((x + (pitch - 1) * y) % pitch == 0 ? 20 : 235) * 257);
    }
    expectLines(hatched, 50, "hatching every " + std::to_string(pitch) + " px");
  }
  // Black and white pixels at random are no lines.
  std::mt19937 random(3);
  for (const double share : {0.1, 0.3, 0.5, 0.7}) {
    std::bernoulli_distribution black(share);
    GreyImage specks(600, 400);
    for (std::uint16_t& pixel : specks.pixels) pixel = static_cast<std::uint16_t>((black(random) ? 20 : 235) * 257);
    EXPECT_EQ(mask(specks, {}, {}).count(), 0) << share;
  }
}

/// Lines both ways at 45 degrees, ink as wide as `ink` and every `spacing` px.
GreyImage netPage(double spacing, double ink, double noise) {
  GreyImage page(600, 400);
  std::mt19937 random(5);
  std::normal_distribution<double> grain(0.0, 1.0);
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      const double a = std::fabs(std::remainder((x - y) / std::sqrt(2.0), spacing));
      const double b = std::fabs(std::remainder((x + y) / std::sqrt(2.0), spacing));
      const double cover = std::clamp(0.5 * ink - std::min(a, b) + 0.5, 0.0, 1.0);
      const double level = 235.0 - 215.0 * cover + noise * grain(random);
      page.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * 257.0));
    }
  }
  return page;
}

TEST(Thresholds, FindNetsWhoseLinesAreWiderThanThePaperBetweenThem) {
  for (const auto& [spacing, ink] : {std::pair(8.5, 4.5), {11.3, 7.6}, {14.0, 9.0}}) {
    for (const double noise : {0.0, 4.0})
      expectLines(netPage(spacing, ink, noise), 10, std::to_string(spacing) + " px, ink " + std::to_string(ink));
  }
}

TEST(Thresholds, FindHairlinesFourPixelsApartBothWays) { expectLines(netPage(4.0, 1.25, 0.0), 5, "net"); }

TEST(Thresholds, FindHatchingWhosePixelsAreMoreOftenDarkThanBright) {
  // Lines of 1.25 px every 3 px, seen by pixels that they cover in part.
  constexpr std::array<int, 3> kRows = {255, 114, 86};
  GreyImage page(600, 400);
  for (int y = 0; y < page.height; ++y)
    for (int x = 0; x < page.width; ++x) page.row(y)[x] = static_cast<std::uint16_t>(kRows[y % 3] * 257);
  expectLines(page, 50, "rows");
}

/// How many lines side by side a row, or a column, of the ink holds, on an average of three.
double linesAcross(const BitImage& ink, bool isDown) {
  const int length = isDown ? ink.height : ink.width, other = isDown ? ink.width : ink.height;
  int lines = 0;
  for (const int at : {other / 4, other / 2, 3 * other / 4}) {
    for (int i = 1; i < length; ++i) {
      const auto isInk = [&](int k) { return isDown ? ink.at(at, k) : ink.at(k, at); };
      lines += isInk(i) && !isInk(i - 1) ? 1 : 0;
    }
  }
  return lines / 3.0;
}

// As few pixels as show a wave of lines make any two, three or four greys of it, and meet the cells of the paper in
// step.
TEST(Thresholds, HatchingIsFoundHoweverThePixelsMeetIt) {
  for (const double spacing : {2.83, 3.5, 4.0, 4.24}) {
    for (const double offset : {0.0, 0.25, 0.5, 1.0}) {
      const GreyImage down = test::hatchingPage({.angleDeg = 90.0, .spacingPx = spacing, .offsetPx = offset});
      const double lines = 600.0 / spacing, obliqueLines = 400.0 / (std::sqrt(2.0) * spacing);
      EXPECT_NEAR(linesAcross(mask(down, {}, {}), false), lines, 0.05 * lines) << spacing << " from " << offset;
      const GreyImage oblique = test::hatchingPage({.angleDeg = 45.0, .spacingPx = spacing, .offsetPx = offset});
      EXPECT_NEAR(linesAcross(mask(oblique, {}, {}), true), obliqueLines, 0.05 * obliqueLines)
          << spacing << " oblique, from " << offset;
    }
  }
}

TEST(Thresholds, ANetOfHairlinesKeepsThePixelsBetweenItsCrossings) {
  GreyImage page(600, 400);
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      const bool isInk = (x + y) % 6 == 0 || (x - y + 600) % 6 == 1;
      page.row(y)[x] = static_cast<std::uint16_t>((isInk ? 20 : 235) * 257);
    }
  }
  expectLines(page, 50, "net of single pixels");
}

constexpr int kLetterPx = 7, kRowPx = 12;

/// Bowls of 1.6 px with stems beside them, in rows over the whole page: the middle of bowl (i, j) lies in the middle of
/// its cell of kLetterPx by kRowPx.
GreyImage letterPage() {
  GreyImage page(600, 400);
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      const int at = x % kLetterPx - kLetterPx / 2, row = y % kRowPx - kRowPx / 2;
      const double bowl = std::fabs(std::hypot(at, row) - 2.4),
                   stem = std::max(std::abs(at + 2.4), std::abs(row) - 4.0);
      const double cover = std::clamp(0.8 - std::min(bowl, (x / kLetterPx) % 2 == 0 ? stem : bowl) + 0.5, 0.0, 1.0);
      page.row(y)[x] = static_cast<std::uint16_t>(std::lround((235.0 - 215.0 * cover) * 257.0));
    }
  }
  return page;
}

TEST(Thresholds, LettersInDenseRowsKeepTheirCounters) {
  const BitImage found = mask(letterPage(), {}, {});
  int letters = 0, open = 0, inked = 0;
  for (int y = kRowPx / 2; y + kRowPx < 400; y += kRowPx) {
    for (int x = kLetterPx / 2; x + kLetterPx < 600; x += kLetterPx, ++letters) {
      open += found.at(x, y) ? 0 : 1;
      inked += found.at(x, y - 2) && found.at(x, y + 2) ? 1 : 0;
    }
  }
  EXPECT_GT(open, 0.95 * letters);
  EXPECT_GT(inked, 0.95 * letters);
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
  const Page page = drawPage(900, 700, {100.0, 100.0, 50.0, 4.0});
  ThresholdParams params;
  params.reach = 0.5;
  EXPECT_EQ(mask(page.grey, {}, params, 1), mask(page.grey, {}, params, 4));
}

TEST(Thresholds, OtsuParEachRegionAndFillsEmptyOnes) {
  const Page page = drawPage(640, 480, {210.0, 20.0, 150.0, 3.0});
  const auto found = findThresholds(page.grey, {false}, {}, {});
  EXPECT_TRUE(found->paper.isEmpty());
  EXPECT_TRUE(found->foundLine);
  EXPECT_FALSE(found->measured[7]);
  EXPECT_EQ(wrongPixels(page, mask(page.grey, {false}, {})), 0);
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
  const BitImage ink = mask(page, {false}, params);
  EXPECT_EQ(ink.count(), 20 * 20);
  EXPECT_TRUE(ink.at(150, 10));
  const auto found = findThresholds(page, {false}, params, {});
  EXPECT_EQ(found->level[7], 150.0);
  EXPECT_EQ(found->level[6], 50.0);
  params.manualLevel = 256.0;
  EXPECT_EQ(findThresholds(page, {}, params, {}).error().code, ErrorCode::BadParameter);
}

TEST(Thresholds, StrengthAsksForDarkerInk) {
  const Page page = drawPage(640, 480, {200.0, 20.0, 100.0, 2.0});
  ThresholdParams weak, strong;
  weak.strength = 0.6;
  strong.strength = 1.6;
  EXPECT_GT(mask(page.grey, {}, weak).count(), mask(page.grey, {}, {}).count());
  EXPECT_LT(mask(page.grey, {}, strong).count(), mask(page.grey, {}, {}).count());
}

TEST(Thresholds, HistogramsCountEveryPixelOnce) {
  const Page page = drawPage(643, 481, {100.0, 100.0, 50.0, 4.0});
  std::uint64_t total = 0;
  for (int region = 0; region < kRegions; ++region) {
    for (const auto n : regionHistogram(page.grey, region)) total += n;
  }
  EXPECT_EQ(total, 643u * 481u);
}

TEST(PushPull, KeepsSureCellsAndFillsTheRestWithinTheirRange) {
  std::vector<float> values(21 * 13, 0.0f), weights(values.size(), 0.0f);
  values[5] = 3.0f;
  weights[5] = 1.0f;
  values[200] = 9.0f;
  weights[200] = 1.0f;
  const auto filled = pushPull(values, weights, 21, 13);
  EXPECT_EQ(filled[5], 3.0f);
  EXPECT_EQ(filled[200], 9.0f);
  for (const float v : filled) {
    EXPECT_GE(v, 3.0f - 1e-4f);
    EXPECT_LE(v, 9.0f + 1e-4f);
  }
}

}  // namespace
}  // namespace batten
