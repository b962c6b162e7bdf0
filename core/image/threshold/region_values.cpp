// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/region_values.h"

namespace batten {

RegionBounds regionBounds(int width, int height, int region) {
  const auto cut = [](int size, int i) { return static_cast<int>(static_cast<long long>(i) * size / kRegionsPerSide); };
  const int column = region % kRegionsPerSide, row = region / kRegionsPerSide;
  return {cut(width, column), cut(height, row), cut(width, column + 1), cut(height, row + 1)};
}

Vec2 regionCentre(int width, int height, int region) {
  const int column = region % kRegionsPerSide, row = region / kRegionsPerSide;
  return {(column + 0.5) * width / kRegionsPerSide, (row + 0.5) * height / kRegionsPerSide};
}

std::array<std::uint32_t, 256> regionHistogram(const GreyImage& image, int region) {
  std::array<std::uint32_t, 256> counts{};
  const RegionBounds bounds = regionBounds(image.width, image.height, region);
  for (int y = bounds.y0; y < bounds.y1; ++y) {
    const std::uint16_t* row = image.row(y);
    for (int x = bounds.x0; x < bounds.x1; ++x) ++counts[(row[x] + 128u) / 257u];
  }
  return counts;
}

}  // namespace batten
