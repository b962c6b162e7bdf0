// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/region_surface.h"

#include <algorithm>
#include <cmath>

#include "core/base/hot_loop.h"
#include "core/image/threshold/region_thresholds.h"
#include "core/image/threshold/region_values.h"

namespace batten {
namespace {

constexpr int kLast = kRegionsPerSide - 1;  // index

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

RegionSurface::RowLines RegionSurface::linesOfRow(int y) const {
  const auto [row, share] = rowAt(y);
  const auto valueOf = [&, top = row, part = share](int c) {
    const double value = values_[top * kRegionsPerSide + c];
    return interpolate_ ? value + part * (values_[(top + 1) * kRegionsPerSide + c] - value) : value;
  };
  const double pitch = static_cast<double>(width_) / kRegionsPerSide;
  RowLines lines{};
  for (int c = -1; c < kRegionsPerSide; ++c) {
    RowLine& line = lines[c + 1];
    if (!interpolate_ || c < 0 || c == kLast) {
      line.first = static_cast<float>(valueOf(std::max(c, 0)));
      continue;
    }
    const double left = valueOf(c), slope = (valueOf(c + 1) - left) / pitch;
    line.first = static_cast<float>(left + slope * (starts_[c] + 0.5 - (c + 0.5) * pitch));
    line.slope = static_cast<float>(slope);
  }
  return lines;
}

int RegionSurface::stretchAt(int x) const {
  int stretch = 0;
  while (stretch < kRegionsPerSide && starts_[stretch] <= x) ++stretch;
  return stretch;
}

void RegionSurface::fillRow(int y, int x0, int x1, float* out) const {
  fillStretches(linesOfRow(y), stretchAt(x0), x0, x1, out);
}

void RegionSurface::fillStretches(const RowLines& lines, int stretch, int x0, int x1, float* out) const {
  for (int x = x0; x < x1; ++stretch) {
    const int start = startOf(stretch);
    const int end = std::min(starts_[stretch], x1);
    fillLine(out + (x - x0), x - start, end - start, lines[stretch].first, lines[stretch].slope);
    x = end;
  }
}

RegionSurface::RowBounds RegionSurface::highestByStretch(int y0, int y1) const {
  std::array<double, kRegionsPerSide> highest{};
  const int first = rowAt(y0).first, last = std::min(rowAt(y1 - 1).first + (interpolate_ ? 1 : 0), kLast);
  for (int c = 0; c < kRegionsPerSide; ++c) {
    highest[c] = values_[first * kRegionsPerSide + c];
    for (int row = first + 1; row <= last; ++row) highest[c] = std::max(highest[c], values_[row * kRegionsPerSide + c]);
  }
  RowBounds bounds{};
  for (int stretch = 0; stretch <= kRegionsPerSide; ++stretch) {
    const int left = std::max(0, stretch - 1), right = interpolate_ ? std::min(stretch, kLast) : left;
    bounds[stretch] = static_cast<float>(std::max(highest[left], highest[right]));
  }
  return bounds;
}

}  // namespace batten
