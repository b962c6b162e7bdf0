// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/region_surface.h"

#include <algorithm>
#include <cmath>

#include "core/base/hot_loop.h"
#include "core/image/region_thresholds.h"
#include "core/image/region_values.h"

namespace batten {
namespace {

constexpr int kLast = kRegionsPerSide - 1;

BATTEN_HOT_LOOP void fillLine(float* out, int count, float start, float slope) {
  for (int i = 0; i < count; ++i) out[i] = start + slope * static_cast<float>(i);
}

/// Index of the last i with floor(i * size / 8) <= position.
int slotOf(int position, int size) {
  int slot = static_cast<int>((static_cast<long long>(position) * kRegionsPerSide) / size);
  while (slot < kLast && static_cast<long long>(slot + 1) * size / kRegionsPerSide <= position) ++slot;
  return slot;
}

}  // namespace

int regionOf(int x, int y, int width, int height) { return slotOf(y, height) * kRegionsPerSide + slotOf(x, width); }

RegionSurface::RegionSurface(const RegionValues& values, int width, int height, bool interpolate)
    : values_(values), width_(width), height_(height), interpolate_(interpolate) {}

void RegionSurface::fillRow(int y, float* out) const {
  std::array<double, kRegionsPerSide> columns{};
  if (!interpolate_) {
    const int row = slotOf(y, height_);
    for (int c = 0; c < kRegionsPerSide; ++c) {
      const RegionBounds bounds = regionBounds(width_, height_, row * kRegionsPerSide + c);
      const auto value = static_cast<float>(values_[row * kRegionsPerSide + c]);
      std::fill(out + bounds.x0, out + bounds.x1, value);
    }
    return;
  }
  const double v = std::clamp((y + 0.5) * kRegionsPerSide / height_ - 0.5, 0.0, double{kLast});
  const int top = std::min(static_cast<int>(v), kLast - 1);
  for (int c = 0; c < kRegionsPerSide; ++c) {
    const auto above = static_cast<std::size_t>(top * kRegionsPerSide + c);
    columns[c] = values_[above] + (v - top) * (values_[above + kRegionsPerSide] - values_[above]);
  }
  const double pitch = static_cast<double>(width_) / kRegionsPerSide;
  // Pixel x has its centre at x + .5; the first pixel right of centre c is the first with x + .5 >= (c + .5) pitch.
  const auto firstRightOf = [&](int c) {
    return std::clamp(static_cast<int>(std::ceil((c + 0.5) * pitch - 0.5)), 0, width_);
  };
  std::fill(out, out + firstRightOf(0), static_cast<float>(columns[0]));
  for (int c = 0; c < kLast; ++c) {
    const int begin = firstRightOf(c), end = firstRightOf(c + 1);
    const double left = columns[c], right = columns[c + 1];
    const double slope = (right - left) / pitch;
    const double start = left + slope * (begin + 0.5 - (c + 0.5) * pitch);
    fillLine(out + begin, end - begin, static_cast<float>(start), static_cast<float>(slope));
  }
  std::fill(out + firstRightOf(kLast), out + width_, static_cast<float>(columns[kLast]));
}

}  // namespace batten
