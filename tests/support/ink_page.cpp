// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ink_page.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace batten::test {

void inkOver(std::vector<float>& coverage, const std::vector<float>& ink) {
  for (std::size_t i = 0; i < coverage.size(); ++i) coverage[i] = std::max(coverage[i], ink[i]);
}

PageStyle penPage(double noise, std::uint32_t seed) {
  PageStyle style;
  style.paperLeft = style.paperRight = 240.0;
  style.inkLevel = 30.0;
  style.blurPx = 0.8;
  style.noise = noise;
  style.seed = seed;
  return style;
}

BitImage penInk(const GreyImage& grey) {
  constexpr double kHalfway = 135.0;
  BitImage ink(grey.width, grey.height);
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x) ink.set(x, y, grey.level(x, y) < kHalfway);
  return ink;
}

InkPage scannedInks(const std::vector<std::vector<float>>& inks, int width, int height, double noise,
                    std::uint32_t seed) {
  std::vector<float> coverage(std::ptrdiff_t{width} * height, 0.0f);
  for (const std::vector<float>& ink : inks) inkOver(coverage, ink);
  GreyImage grey = renderPage(std::move(coverage), width, height, penPage(noise, seed)).grey;
  return {penInk(grey), std::move(grey)};
}

}  // namespace batten::test
