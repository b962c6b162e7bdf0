// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/region_surface.h"

#include <algorithm>
#include <cmath>

#include "core/base/hot_loop.h"
#include "core/image/threshold/region_thresholds.h"
#include "core/image/threshold/region_values.h"

namespace batten {
namespace {

constexpr int kLast = kRegionsPerSide - 1;

/// Values [begin, end) of a line whose value 0 is `start`.
BATTEN_HOT_LOOP void fillLine(float* out, int begin, int end, float start, float slope) {
  for (int i = begin; i < end; ++i) out[i - begin] = start + slope * static_cast<float>(i);
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
    : values_(values), width_(width), height_(height), interpolate_(interpolate) {
  // Pixel x has its centre at x + .5; the first pixel right of centre c is the first with x + .5 >= (c + .5) pitch.
  const double pitch = static_cast<double>(width_) / kRegionsPerSide;
  for (int c = 0; c < kRegionsPerSide; ++c) {
    starts_[c] = interpolate_ ? std::clamp(static_cast<int>(std::ceil((c + 0.5) * pitch - 0.5)), 0, width_)
                              : regionBounds(width_, height_, c).x0;
  }
  starts_[kRegionsPerSide] = width_;
}

RegionSurface::Place RegionSurface::rowAt(int y) const {
  if (!interpolate_) return {slotOf(y, height_), 0.0};
  const double v = std::clamp((y + 0.5) * kRegionsPerSide / height_ - 0.5, 0.0, double{kLast});
  const int top = std::min(static_cast<int>(v), kLast - 1);
  return {top, v - top};
}

void RegionSurface::fillRow(int y, int x0, int x1, float* out) const {
  const auto [row, share] = rowAt(y);
  const auto valueOf = [&, top = row, part = share](int c) {
    const double value = values_[top * kRegionsPerSide + c];
    return interpolate_ ? value + part * (values_[(top + 1) * kRegionsPerSide + c] - value) : value;
  };
  const double pitch = static_cast<double>(width_) / kRegionsPerSide;
  for (int c = -1; c < kRegionsPerSide; ++c) {
    const int start = c < 0 ? 0 : starts_[c];
    const int begin = std::max(start, x0), end = std::min(starts_[c + 1], x1);
    if (begin >= end) continue;
    float* to = out + (begin - x0);
    if (!interpolate_ || c < 0 || c == kLast) {
      std::fill_n(to, end - begin, static_cast<float>(valueOf(std::max(c, 0))));
      continue;
    }
    const double left = valueOf(c), slope = (valueOf(c + 1) - left) / pitch;
    const double first = left + slope * (start + 0.5 - (c + 0.5) * pitch);
    fillLine(to, begin - start, end - start, static_cast<float>(first), static_cast<float>(slope));
  }
}

std::array<double, kRegionsPerSide> RegionSurface::highestByColumn(int y0, int y1) const {
  std::array<double, kRegionsPerSide> highest{};
  const int first = rowAt(y0).first, last = std::min(rowAt(y1 - 1).first + (interpolate_ ? 1 : 0), kLast);
  for (int c = 0; c < kRegionsPerSide; ++c) {
    highest[c] = values_[first * kRegionsPerSide + c];
    for (int row = first + 1; row <= last; ++row) highest[c] = std::max(highest[c], values_[row * kRegionsPerSide + c]);
  }
  return highest;
}

std::pair<int, int> RegionSurface::columnsOf(int x0, int x1) const {
  int first = 0, last = 0;
  while (first < kLast && starts_[first + 1] <= x0) ++first;
  while (last < kLast && starts_[last] < x1) ++last;
  return {first, last};
}

}  // namespace batten
