// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten::test {

/// Makes the ink of a mask that of a dry brush or of chalk: brighter by up to 2 x `mottle` [grey], in patches of 5 px.
inline void dryInk(GreyImage& grey, const BitImage& ink, double mottle, unsigned seed = 7) {
  constexpr int kPatchPx = 5;
  const int columns = grey.width / kPatchPx + 1;
  std::mt19937 random(seed);
  std::vector<double> patch(std::ptrdiff_t{columns} * (grey.height / kPatchPx + 1));
  for (double& p : patch) p = mottle * static_cast<double>(random() % 1000) / 500.0;
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      if (!ink.at(x, y)) continue;
      const double level = grey.level(x, y) + patch[y / kPatchPx * columns + x / kPatchPx];
      grey.row(y)[x] = static_cast<std::uint16_t>(std::clamp(level, 0.0, 255.0) * GreyImage::kGreyUnit);
    }
  }
}

}  // namespace batten::test
