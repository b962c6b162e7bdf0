// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "core/image/region_thresholds.h"

namespace batten {
namespace {

std::optional<Error> outOfRange(const char* message) { return Error{ErrorCode::BadParameter, message, {}}; }
bool within(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

std::optional<Error> validate(const ThresholdParams& params) {
  if (!within(params.manualLevel, 0.0, 255.0)) return outOfRange("The threshold must lie between 0 and 255.");
  if (!within(params.strength, 0.2, 3.0)) return outOfRange("The threshold strength must lie between 0.2 and 3.");
  if (!within(params.reach, 0.0, 1.0)) return outOfRange("The threshold reach must lie between 0 and 1.");
  if (params.speckArea < 0) return outOfRange("The speck area must not be negative.");
  if (params.holeArea < 0) return outOfRange("The hole area must not be negative.");
  for (const auto& level : params.grid) {
    if (level && !within(*level, 0.0, 255.0)) return outOfRange("A region's threshold must lie between 0 and 255.");
  }
  return std::nullopt;
}

RegionBounds regionBounds(int width, int height, int region) {
  const auto cut = [](int size, int i) { return static_cast<int>(static_cast<long long>(i) * size / kRegionsPerSide); };
  const int column = region % kRegionsPerSide, row = region / kRegionsPerSide;
  return {cut(width, column), cut(height, row), cut(width, column + 1), cut(height, row + 1)};
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

double PaperBackground::at(double xPx, double yPx) const {
  if (isEmpty()) return 255.0;
  const double u = std::clamp(xPx / cellPx - 0.5, 0.0, columns - 1.0);
  const double v = std::clamp(yPx / cellPx - 0.5, 0.0, rows - 1.0);
  const int x0 = static_cast<int>(u), y0 = static_cast<int>(v);
  const int x1 = std::min(x0 + 1, columns - 1), y1 = std::min(y0 + 1, rows - 1);
  const auto cell = [&](int x, int y) {
    return static_cast<double>(
        grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)]);
  };
  const double above = cell(x0, y0) + (u - x0) * (cell(x1, y0) - cell(x0, y0));
  const double below = cell(x0, y1) + (u - x0) * (cell(x1, y1) - cell(x0, y1));
  double level = above + (v - y0) * (below - above);
  for (const PaperFold& fold : folds) level += fold.at(xPx, yPx);
  return level;
}

}  // namespace batten
