// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/sheet_levels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/parallel.h"
#include "core/base/statistics.h"

namespace batten {

std::vector<float> levelsOfCells(const GreyImage& page, const BitImage& inside, int cellPx, const RunContext& context) {
  constexpr int kRowsOfCells = 8;  // that a thread takes at a time
  std::vector<float> levels(std::ptrdiff_t{inside.width} * inside.height, 0.0f);
  parallelFor(context, inside.height, kRowsOfCells, [&](int begin, int end) {
    std::vector<float> pixels;
    for (int j = begin; j < end; ++j) {
      for (int i = 0; i < inside.width; ++i) {
        if (!inside.at(i, j)) continue;
        pixels.clear();
        for (int y = j * cellPx; y < (j + 1) * cellPx; ++y) {
          for (int x = i * cellPx; x < (i + 1) * cellPx; ++x) pixels.push_back(static_cast<float>(page.row(y)[x]));
        }
        levels[std::ptrdiff_t{j} * inside.width + i] = upperMedian(pixels);
      }
    }
  });
  return levels;
}

RowBetweenCells::RowBetweenCells(std::span<const float> values, int columns, int cellPx, int y) : cellPx_(cellPx) {
  const int rows = static_cast<int>(std::ssize(values) / columns);
  const double v = std::clamp((y + 0.5) / cellPx - 0.5, 0.0, rows - 1.0);
  const int j = static_cast<int>(v);
  upper_ = values.subspan(std::ptrdiff_t{j} * columns, columns);
  lower_ = values.subspan(std::ptrdiff_t{std::min(j + 1, rows - 1)} * columns, columns);
  share_ = v - j;
}

double RowBetweenCells::at(int x) const {
  const double u = std::clamp((x + 0.5) / cellPx_ - 0.5, 0.0, static_cast<double>(std::ssize(upper_)) - 1.0);
  const int i = static_cast<int>(u), next = std::min(i + 1, static_cast<int>(std::ssize(upper_)) - 1);
  const auto along = [&](std::span<const float> row) {
    const double here = static_cast<double>(row[i]);
    return here + (u - i) * (static_cast<double>(row[next]) - here);
  };
  const double above = along(upper_);
  return above + share_ * (along(lower_) - above);
}

}  // namespace batten
