// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/pixel_window.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/hot_loop.h"

namespace batten {
namespace {

constexpr double kParallel = 1e-9;  // cosine: a row that runs along a strip crosses no side of it

/// The oblong of a window: rows of pixel centres are cut to |along| < kHalfPx and |across| < half.
struct WindowCut {
  double normalX, normalY, alongX, alongY, half;
  double x, y;  // its centre
  double width;
  int top;
};

/// Where a row enters and leaves, from its first pixel centre on and clipped to the page; it ends before the page where
/// it does not, so that no pixel lies between.
struct RowCut {
  double from, to;
};
inline RowCut clippedCut(const WindowCut& c, double from, double to) {
  const double right = c.width - 1.0, left = c.x + from - 0.5, end = c.x + to - 0.5;
  const double low = left > 0.0 ? left : 0.0, high = end > -1.0 ? end : -1.0;
  const double first = low < c.width ? low : c.width, last = high < right ? high : right;
  return {first, from <= to ? last : -1.0};
}

BATTEN_HOT_LOOP void cutRows(const WindowCut& c, int rows, double* __restrict from, double* __restrict to) {
  constexpr double kAlong = PixelWindow::kHalfPx;  // [px] short for the formulas below
  for (int r = 0; r < rows; ++r) {
    const double dy = (c.top + r) + 0.5 - c.y;
    const double across = dy * c.normalY, along = dy * c.alongY;
    const double a = (-c.half - across) / c.normalX, b = (c.half - across) / c.normalX;
    const double d = (-kAlong - along) / c.alongX, e = (kAlong - along) / c.alongX;
    const double low = a < b ? a : b, high = a < b ? b : a, left = d < e ? d : e, right = d < e ? e : d;
    const RowCut cut = clippedCut(c, low < left ? left : low, right < high ? right : high);
    from[r] = cut.from;
    to[r] = cut.to;
  }
}

/// The same where the rows run along the oblong, or square to it.
void cutParallelRows(const WindowCut& c, int rows, double* from, double* to) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();  // [px] a row that nothing cuts
  for (int r = 0; r < rows; ++r) {
    const double dy = (c.top + r) + 0.5 - c.y;
    double low = -kEndless, high = kEndless;
    const auto cut = [&](double rate, double offset, double limit) {
      if (std::abs(rate) < kParallel) {
        if (std::abs(offset) > limit) high = -kEndless;
        return;
      }
      const double a = (-limit - offset) / rate, b = (limit - offset) / rate;
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    };
    cut(c.normalX, dy * c.normalY, c.half);
    cut(c.alongX, dy * c.alongY, PixelWindow::kHalfPx);
    const RowCut clipped = clippedCut(c, low, high);
    from[r] = clipped.from;
    to[r] = clipped.to;
  }
}

/// From the places about the centre of a window (in `distance` and `weight`) and the samples (in `grey`).
BATTEN_HOT_LOOP void measurePixels(const WindowCut& c, double middle, int count, double* __restrict distance,
                                   double* __restrict weight, double* __restrict grey) {
  for (int i = 0; i < count; ++i) {
    const double dx = distance[i], dy = weight[i];
    const double off = 1.0 - std::abs(dx * c.alongX + dy * c.alongY) / PixelWindow::kHalfPx;
    distance[i] = dx * c.normalX + dy * c.normalY + middle;
    weight[i] = off > 0.0 ? off : 0.0;
    grey[i] = grey[i] / GreyImage::kGreyUnit;
  }
}

}  // namespace

void PixelWindow::read(const GreyImage& grey, const Vec2& base, const Vec2& normal, double lo, double hi) {
  count_ = 0;
  const Vec2 along(normal.y(), -normal.x());
  const double middle = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
  const Vec2 centre = base + middle * normal;
  const double height = std::abs(normal.y()) * half + std::abs(along.y()) * kHalfPx;
  const int top = std::max(0, static_cast<int>(std::ceil(centre.y() - height - 0.5)));
  const int bottom = std::min(grey.height - 1, static_cast<int>(std::floor(centre.y() + height - 0.5)));
  const int rows = bottom - top + 1;
  if (rows <= 0) return;
  const WindowCut cut{normal.x(), normal.y(), along.x(),          along.y(), half,
                      centre.x(), centre.y(), double(grey.width), top};
  if (std::ssize(from_) < rows) {
    from_.resize(rows);
    to_.resize(rows);
  }
  const bool isParallel = std::abs(normal.x()) < kParallel || std::abs(along.x()) < kParallel;
  (isParallel ? cutParallelRows : cutRows)(cut, rows, from_.data(), to_.data());
  std::ptrdiff_t most = kLanes;
  for (int r = 0; r < rows; ++r) most += static_cast<std::ptrdiff_t>(std::max(0.0, to_[r] - from_[r] + 1.0));
  if (std::ssize(distance_) < most) {
    for (std::vector<double>* values : {&distance_, &weight_, &grey_}) values->resize(most);
  }
  double *dx = distance_.data(), *dy = weight_.data(), *level = grey_.data();
  for (int r = 0; r < rows; ++r) {
    const std::uint16_t* row = grey.row(top + r);
    const double down = (top + r) + 0.5 - centre.y(), last = to_[r];
    int x = static_cast<int>(from_[r]);
    if (x < from_[r]) ++x;
    for (; x <= last; ++x) {
      *dx++ = x + 0.5 - centre.x();
      *dy++ = down;
      *level++ = row[x];
    }
  }
  count_ = static_cast<int>(dx - distance_.data());
  measurePixels(cut, middle, count_, distance_.data(), weight_.data(), grey_.data());
  for (int i = count_; i < fullCount(); ++i) distance_[i] = weight_[i] = grey_[i] = 0.0;
}

}  // namespace batten
