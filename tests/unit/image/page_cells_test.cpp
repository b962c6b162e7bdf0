// SPDX-License-Identifier: GPL-3.0-or-later
// What lets parts of a page be passed over, against every pixel of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/base/statistics.h"
#include "core/image/bits/packed_flags.h"
#include "core/image/threshold/binned_median.h"
#include "core/image/threshold/darkest_cells.h"
#include "core/image/threshold/plane_ink.h"
#include "core/image/threshold/region_surface.h"

namespace batten {
namespace {

TEST(PackFlags, PutsEveryFlagAtItsBit) {
  std::mt19937 random(1);
  for (int count = 0; count <= 200; ++count) {
    std::vector<std::uint8_t> flags(count);
    for (auto& flag : flags) flag = random() % 2;
    std::vector<std::uint64_t> words(4, ~std::uint64_t{0});
    packFlags(flags.data(), count, words.data());
    for (int x = 0; x < (count + 63) / 64 * 64; ++x)
      EXPECT_EQ((words[x / 64] >> (x % 64)) & 1u, x < count ? flags[x] : 0u) << x << " of " << count;
  }
}

TEST(BinnedMedian, IsTheUpperMedian) {
  std::mt19937 random(2);
  for (const double spread : {0.0, 0.01, 0.5, 4.0, 1000.0}) {
    std::normal_distribution<double> noise(0.3, std::max(spread, 1e-9));
    for (const int count : {1, 2, 3, 100, 101, 4000}) {
      std::vector<float> values;
      for (int i = 0; i < count; ++i) values.push_back(spread > 0.0 ? static_cast<float>(noise(random)) : -7.5f);
      for (int i = 0; i < count / 3; ++i) values[random() % values.size()] = i % 2 == 0 ? 1e9f : -1e9f;
      EXPECT_EQ(binnedMedian(values), upperMedian(std::vector<float>(values)));
    }
  }
}

TEST(DarkestCells, HoldTheDarkestPixelOfEach) {
  std::mt19937 random(3);
  for (const auto& [width, height] : {std::pair{64, 64}, {1, 1}, {7, 3}, {8, 4}, {9, 5}, {331, 70}, {17, 129}}) {
    GreyImage image(width, height);
    for (auto& pixel : image.pixels) pixel = static_cast<std::uint16_t>(random());
    for (const int threads : {1, 3}) {
      RunContext context;
      context.threads = threads;
      const DarkestCells cells(image, context);
      ASSERT_EQ(cells.columns(), (width + 7) / 8);
      ASSERT_EQ(cells.rows(), (height + 3) / 4);
      for (int j = 0; j < cells.rows(); ++j) {
        for (int i = 0; i < cells.columns(); ++i) {
          std::uint16_t low = 0xffff;
          for (int y = 4 * j; y < std::min(4 * j + 4, height); ++y)
            for (int x = 8 * i; x < std::min(8 * i + 8, width); ++x) low = std::min(low, image.row(y)[x]);
          EXPECT_EQ(cells.row(j)[i], low);
        }
      }
    }
  }
}

TEST(RegionSurface, HasNoValueAboveTheBoundsOfItsStretches) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> level(-100.0, 20.0);
  for (const auto& [width, height] : {std::pair{500, 300}, {64, 64}, {11, 5}, {3, 3}}) {
    for (const bool interpolate : {true, false}) {
      RegionValues values;
      for (double& value : values) value = level(random);
      const RegionSurface surface(values, width, height, interpolate);
      std::vector<float> row(width), part(width);
      for (int y0 = 0; y0 < height; y0 += 4) {
        const int y1 = std::min(y0 + 4, height);
        const RegionSurface::RowBounds bounds = surface.highestByStretch(y0, y1);
        for (int y = y0; y < y1; ++y) {
          surface.fillRow(y, row.data());
          for (int x = 0; x < width; ++x) EXPECT_LE(row[x], bounds[surface.stretchAt(x)] + 1e-3f);
          const int from = width / 3, to = width - width / 4;
          surface.fillRow(y, from, to, part.data());
          EXPECT_TRUE(std::equal(part.begin(), part.begin() + (to - from), row.begin() + from));
        }
      }
    }
  }
}

TEST(InkOfPlane, IsThatOfEveryPixelThoughPaperIsPassedOver) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const int shrink : {1, 2, 4}) {
    for (const auto& [width, height] : {std::pair{300, 90}, {65, 33}, {5, 200}}) {
      Plane grey(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          grey.row(y)[x] = static_cast<float>(200.0 - 40.0 * x / width + 6.0 * share(random) -
                                              (share(random) < 0.02  ? 60.0
                                               : share(random) < 0.1 ? 9.0
                                                                     : 0.0));
      PaperBackground paper;
      paper.cellPx = 8;
      paper.columns = (width * shrink + 7) / 8;
      paper.rows = (height * shrink + 7) / 8;
      for (int i = 0; i < paper.columns * paper.rows; ++i)
        paper.grey.push_back(static_cast<float>(203.0 - 40.0 * (i % paper.columns) / paper.columns + share(random)));
      RegionValues contrasts;
      for (double& value : contrasts) value = -12.0 * share(random);
      const std::vector<float> kernel = gaussianKernel(0.1);
      const BitImage ink = inkOfPlane({grey, paper, contrasts, shrink}, kernel, {});
      const Plane smoothed = smooth(grey, kernel, {});
      const RegionSurface surface(contrasts, width, height, true);
      std::vector<float> level(width);
      for (int y = 0; y < height; ++y) {
        surface.fillRow(y, level.data());
        for (int x = 0; x < width; ++x) {
          const auto here = static_cast<float>(paper.at((x + 0.5) * shrink, (y + 0.5) * shrink));
          EXPECT_EQ(ink.at(x, y), smoothed.row(y)[x] < here + level[x]);
        }
      }
      EXPECT_GT(ink.count(), 0);
    }
  }
}

}  // namespace
}  // namespace batten
