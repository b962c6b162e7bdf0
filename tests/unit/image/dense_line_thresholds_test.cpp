// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds of hatching, nets and letters so dense that the paper between the lines hardly shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/support/hatching_page.h"
#include "tests/unit/image/known_ink_page.h"

namespace batten {
namespace {

using test::KnownInkPage;
using test::thresholded;
using test::wrongPixels;

/// Lines 2.5 px wide all over the page, `spacing` px from middle to middle, at 45 degrees; with gradation and noise.
KnownInkPage hatchedPage(int width, int height, double spacing, double fall, double noise) {
  KnownInkPage page{GreyImage(width, height), BitImage(width, height), BitImage(width, height)};
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
      const KnownInkPage page = hatchedPage(600, 400, spacing, 20.0, noise);
      EXPECT_LT(wrongPixels(page, thresholded(page.grey, {}, {})), 600 * 400 / 200)
          << spacing << " px, noise " << noise;
    }
  }
  // As dense, but no lines: noise of a sensor and of single pixels.
  std::mt19937 random(3);
  std::normal_distribution<double> grain(128.0, 60.0);
  GreyImage page(600, 400);
  for (std::uint16_t& pixel : page.pixels)
    pixel = static_cast<std::uint16_t>(std::lround(std::clamp(grain(random), 0.0, 255.0) * 257.0));
  EXPECT_EQ(thresholded(page, {}, {}).count(), 0);
}

/// What is darker than 128 is found as ink, but for one pixel of `allowedOneOf`.
void expectLines(const GreyImage& page, int allowedOneOf, const std::string& what) {
  const BitImage found = thresholded(page, {}, {});
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
    EXPECT_EQ(thresholded(specks, {}, {}).count(), 0) << share;
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

/// Rings at random, of thin lines, up to the border of a disc that is paper but for one ring within it.
GreyImage ornamentPage() {
  constexpr double kDiscPx = 70.0, kRingPx = 40.0;
  GreyImage page(360, 500);
  std::vector<double> ink(page.pixels.size(), 0.0);
  const auto addRing = [&](double cx, double cy, double radius) {
    for (int y = 0; y < page.height; ++y) {
      for (int x = 0; x < page.width; ++x) {
        const double off = std::fabs(std::hypot(x + 0.5 - cx, y + 0.5 - cy) - radius);
        double& here = ink[std::ptrdiff_t{y} * page.width + x];
        here = std::max(here, std::clamp(1.4 - off, 0.0, 1.0));
      }
    }
  };
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 1100; ++i) {
    const double x = 360.0 * share(random), y = 500.0 * share(random), radius = 2.0 + 4.0 * share(random);
    if (std::hypot(x - 180.0, y - 250.0) > kDiscPx + radius) addRing(x, y, radius);
  }
  addRing(180.0, 250.0, kRingPx);
  for (double& here : ink) here *= 0.7;
  // Black cells: next to their edges those of the lines are weak.
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < page.width; ++x)
      if (x % 14 > 2 && y % 14 > 2) ink[std::ptrdiff_t{y} * page.width + x] = 1.2;
  for (std::size_t i = 0; i < ink.size(); ++i)
    page.pixels[i] = static_cast<std::uint16_t>(std::lround((250.0 - 200.0 * ink[i]) * 257.0));
  return page;
}

/// Most lines of a page full of them are no edges there: what was taken for noise of the paper is lines.
TEST(Thresholds, FindOrnamentsThatFillThePage) {
  const GreyImage page = ornamentPage();
  const BitImage found = thresholded(page, {}, {});
  int ink = 0, missing = 0, bright = 0, wrong = 0;
  for (int y = 130; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      const bool isInk = page.level(x, y)<120.0, isPaper = page.level(x, y)> 240.0;
      ink += isInk ? 1 : 0;
      missing += isInk && !found.at(x, y) ? 1 : 0;
      bright += isPaper ? 1 : 0;
      wrong += isPaper && found.at(x, y) ? 1 : 0;
    }
  }
  EXPECT_LT(missing, ink / 20);
  EXPECT_LT(wrong, bright / 20);
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
      EXPECT_NEAR(linesAcross(thresholded(down, {}, {}), false), lines, 0.05 * lines) << spacing << " from " << offset;
      const GreyImage oblique = test::hatchingPage({.angleDeg = 45.0, .spacingPx = spacing, .offsetPx = offset});
      EXPECT_NEAR(linesAcross(thresholded(oblique, {}, {}), true), obliqueLines, 0.05 * obliqueLines)
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
  const BitImage found = thresholded(letterPage(), {}, {});
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

}  // namespace
}  // namespace batten
