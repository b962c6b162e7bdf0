// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace batten {
namespace {

GreyImage randomGrey(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  GreyImage image(width, height);
  for (auto& pixel : image.pixels) pixel = static_cast<std::uint16_t>(random());
  return image;
}

TEST(ShrinkGrey, IsTheMeanOverEveryBlock) {
  for (const int shrink : {1, 2, 3, 4, 5, 8}) {
    for (const auto& [width, height] : {std::pair{64, 40}, {67, 33}, {3, 5}, {129, 7}}) {
      const GreyImage image = randomGrey(width, height, static_cast<unsigned>(shrink));
      const Plane means = shrinkGrey(image, shrink, {});
      ASSERT_EQ(means.width, (width + shrink - 1) / shrink);
      ASSERT_EQ(means.height, (height + shrink - 1) / shrink);
      for (int y = 0; y < means.height; ++y) {
        for (int x = 0; x < means.width; ++x) {
          const int x1 = std::min((x + 1) * shrink, width), y1 = std::min((y + 1) * shrink, height);
          double sum = 0.0;
          for (int v = y * shrink; v < y1; ++v)
            for (int u = x * shrink; u < x1; ++u) sum += image.row(v)[u];
          const double mean = sum / ((x1 - x * shrink) * (y1 - y * shrink)) / GreyImage::kGreyUnit;
          EXPECT_FLOAT_EQ(means.row(y)[x], static_cast<float>(mean));
          // By threes and fours the float nearest to the mean.
          if (shrink == 3 || shrink == 4) {
            EXPECT_EQ(means.row(y)[x], static_cast<float>(mean));
          }
        }
      }
    }
  }
}

/// By the definition: from the middle outwards, along the rows first.
float smoothedAt(const Plane& in, const std::vector<float>& kernel, int x, int y) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  const auto along = [&](int row) {
    const float* values = in.row(std::clamp(row, 0, in.height - 1));
    const auto at = [&](int i) { return values[std::clamp(i, 0, in.width - 1)]; };
    float sum = kernel[0] * at(x);
    for (int k = 1; k <= radius; ++k) sum += kernel[k] * (at(x - k) + at(x + k));
    return sum;
  };
  float sum = kernel[0] * along(y);
  for (int k = 1; k <= radius; ++k) sum += kernel[k] * (along(y - k) + along(y + k));
  return sum;
}

TEST(Smooth, IsTheSameForEveryPixelWithAnyThreads) {
  for (const double variance : {0.0, 0.3, 1.0, 2.0, 4.0}) {
    const std::vector<float> kernel = gaussianKernel(variance);
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 70}, {7, 3}, {13, 129}, {100, 65}}) {
      const Plane in = shrinkGrey(randomGrey(width, height, 3), 1, {});
      for (const int threads : {1, 3}) {
        RunContext context;
        context.threads = threads;
        const Plane out = smooth(in, kernel, context);
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) EXPECT_EQ(out.row(y)[x], smoothedAt(in, kernel, x, y));
      }
    }
  }
}

}  // namespace
}  // namespace batten
