// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/pixel_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "core/contour/centreline/placing/border_sums.h"
#include "core/contour/subpixel/pixel_edge.h"

namespace batten {
namespace {

struct WindowPixel {
  double distance, weight, grey;
  bool operator==(const WindowPixel&) const = default;
};

/// Oracle: one row after the other, one pixel after the other.
std::vector<WindowPixel> pixelsAround(const GreyImage& grey, const Vec2& base, const Vec2& normal, double lo,
                                      double hi) {
  std::vector<WindowPixel> pixels;
  const Vec2 along(normal.y(), -normal.x());
  const double middle = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
  const Vec2 centre = base + middle * normal;
  const double height = std::abs(normal.y()) * half + std::abs(along.y()) * PixelWindow::kHalfPx;
  const int top = std::max(0, static_cast<int>(std::ceil(centre.y() - height - 0.5)));
  const int bottom = std::min(grey.height - 1, static_cast<int>(std::floor(centre.y() + height - 0.5)));
  for (int y = top; y <= bottom; ++y) {
    const double dy = y + 0.5 - centre.y();
    double from = -std::numeric_limits<double>::infinity(), to = -from;
    const auto cut = [&](double rate, double offset, double limit) {
      if (std::abs(rate) < 1e-9) {
        if (std::abs(offset) > limit) to = -std::numeric_limits<double>::infinity();
        return;
      }
      const double a = (-limit - offset) / rate, b = (limit - offset) / rate;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    };
    cut(normal.x(), dy * normal.y(), half);
    cut(along.x(), dy * along.y(), PixelWindow::kHalfPx);
    if (!(from <= to)) continue;
    const int first = std::max(0, static_cast<int>(std::ceil(centre.x() + from - 0.5)));
    const int last = std::min(grey.width - 1, static_cast<int>(std::floor(centre.x() + to - 0.5)));
    for (int x = first; x <= last; ++x) {
      const double dx = x + 0.5 - centre.x(), s = dx * along.x() + dy * along.y();
      pixels.push_back({dx * normal.x() + dy * normal.y() + middle,
                        std::max(0.0, 1.0 - std::abs(s) / PixelWindow::kHalfPx), grey.level(x, y)});
    }
  }
  return pixels;
}

GreyImage randomGrey(int width, int height, std::mt19937& random) {
  GreyImage grey(width, height);
  for (std::uint16_t& v : grey.pixels) v = static_cast<std::uint16_t>(random());
  return grey;
}

TEST(PixelWindow, HoldsThePixelsOfTheOblongToTheLastBit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const GreyImage grey = randomGrey(60, 45, random);
  PixelWindow window;  // one for all, as it is used
  int seen = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double angle = trial % 8 == 0 ? 0.5 * std::numbers::pi * (trial / 8 % 4) : 7.0 * share(random);
    const Vec2 normal(std::cos(angle), std::sin(angle));
    const Vec2 base(70.0 * share(random) - 5.0, 55.0 * share(random) - 5.0);  // some of it beyond the page
    const double lo = -9.0 * share(random), hi = trial % 50 == 0 ? lo - 1.0 : 9.0 * share(random);
    window.read(grey, base, normal, lo, hi);
    const std::vector<WindowPixel> expected = pixelsAround(grey, base, normal, lo, hi);
    ASSERT_EQ(window.count(), std::ssize(expected)) << trial;
    ASSERT_EQ(window.fullCount() % PixelWindow::kLanes, 0);
    for (int i = 0; i < window.count(); ++i) {
      const WindowPixel pixel{window.distance()[i], window.weight()[i], window.grey()[i]};
      ASSERT_EQ(pixel, expected[i]) << trial << ' ' << i;
    }
    for (int i = window.count(); i < window.fullCount(); ++i) EXPECT_EQ(window.weight()[i], 0.0);
    seen += window.count();
  }
  EXPECT_GT(seen, 20000);
}

struct BorderResults {
  std::vector<double> sums, left, byLow, byHigh;
  bool operator==(const BorderResults&) const = default;
};

BorderResults resultsOf(const BorderKernels& kernels, const PixelWindow& window, const StrokeBorders& borders) {
  const int room = window.fullCount();
  BorderResults results{{}, std::vector<double>(room), std::vector<double>(room), std::vector<double>(room)};
  const StrokePixels pixels{window.distance(), window.weight(), window.grey(), window.fullCount()};
  const BorderResiduals residuals{results.left.data(), results.byLow.data(), results.byHigh.data()};
  const BorderSums sums = kernels.sums(pixels, borders, residuals);
  const SquareSums squares = kernels.squares(pixels, residuals);
  results.sums = {sums.ll,    sums.lh,    sums.hh,    sums.l,          sums.h,
                  squares.ll, squares.lh, squares.hh, squares.squares, squares.weights};
  return results;
}

TEST(BorderKernels, TheFastestGiveTheBitsOfThePlain) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const GreyImage grey = randomGrey(60, 45, random);
  PixelWindow window;
  for (int trial = 0; trial < 500; ++trial) {
    const double angle = 7.0 * share(random), width = 12.0 * share(random);
    const Vec2 normal(std::cos(angle), std::sin(angle));
    window.read(grey, {10.0 + 40.0 * share(random), 10.0 + 25.0 * share(random)}, normal, -9.0, 9.0);
    const PixelResponse& response = PixelResponse::forBlur(trial % 16);
    const StrokeBorders borders{response.row(response.direction(normal)),
                                240.0,
                                share(random) - 0.5,
                                200.0,
                                -0.5 * width,
                                0.5 * width + share(random)};
    ASSERT_EQ(resultsOf(plainBorderKernels(), window, borders), resultsOf(borderKernels(), window, borders)) << trial;
  }
}

/// Both borders where they are, on pixels that the model itself has made: nothing is left, and no step is asked for.
TEST(BorderKernels, NothingIsLeftOfWhatTheModelMade) {
  const PixelResponse& response = PixelResponse::forBlur(9);
  const ResponseRow row = response.row(4);
  const StrokeBorders borders{row, 230.0, 0.4, 180.0, -3.2, 2.9};
  std::vector<double> distance, weight, grey;
  for (double d = -8.0; d < 8.0; d += 0.25) {
    distance.push_back(d);
    weight.push_back(0.5);
    grey.push_back(230.0 + 0.4 * d - 180.0 * (row.at(d + 3.2).part - row.at(d - 2.9).part));
  }
  const auto count = static_cast<int>(distance.size());
  std::vector<double> left(distance.size()), byLow(left), byHigh(left);
  const BorderSums sums = borderKernels().sums({distance.data(), weight.data(), grey.data(), count}, borders,
                                               {left.data(), byLow.data(), byHigh.data()});
  EXPECT_NEAR(sums.l, 0.0, 1e-9);
  EXPECT_NEAR(sums.h, 0.0, 1e-9);
  EXPECT_GT(sums.det(), 1.0);
  for (const double e : left) EXPECT_NEAR(e, 0.0, 1e-10);
}

}  // namespace
}  // namespace batten
