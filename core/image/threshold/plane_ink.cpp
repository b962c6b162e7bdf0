// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/plane_ink.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"
#include "core/image/bits/packed_flags.h"

namespace batten {
namespace {

constexpr float kMostLost = 0.01f;  // [grey] more than numbers lose on the way to a level

BATTEN_HOT_LOOP void flagDarker(const float* row, float level, std::uint8_t* __restrict flags, int count) {
  for (int i = 0; i < count; ++i) flags[i] = row[i] < level ? 1 : 0;
}

/// No paper of pixels [x0, x1) of row y of the plane is brighter. Folds only darken it.
float highestPaper(const ShrunkenPage& page, int x0, int x1, int y) {
  const PaperBackground& paper = page.paper;
  if (paper.isEmpty()) return 255.0f;
  const auto cellOf = [&](int pixel, int count) {
    return std::clamp(static_cast<int>((pixel + 0.5) * page.shrink / paper.cellPx - 0.5), 0, count - 1);
  };
  const int c0 = cellOf(x0, paper.columns), c1 = std::min(cellOf(x1, paper.columns) + 1, paper.columns - 1);
  const int r0 = cellOf(y, paper.rows), r1 = std::min(r0 + 1, paper.rows - 1);
  const float* above = paper.grey.data() + std::ptrdiff_t{r0} * paper.columns;
  const float* below = paper.grey.data() + std::ptrdiff_t{r1} * paper.columns;
  return std::max(*std::max_element(above + c0, above + c1 + 1), *std::max_element(below + c0, below + c1 + 1));
}

void compareRowOfPlane(const ShrunkenPage& page, const RegionSurface& contrast, int y, const float* row,
                       BitImage& ink) {
  const RegionSurface::RowLines lines = contrast.linesOfRow(y);
  const RegionSurface::RowBounds bounds = contrast.highestByStretch(y, y + 1);
  std::array<std::uint8_t, 64> flags;
  std::array<float, 64> level;
  for (int word = 0; word < ink.wordsPerRow; ++word) {
    const int x0 = word * 64, x1 = std::min(x0 + 64, ink.width), stretch = contrast.stretchAt(x0);
    const float most = *std::max_element(&bounds[stretch], &bounds[contrast.stretchAt(x1 - 1)] + 1);
    flagDarker(row + x0, highestPaper(page, x0, x1, y) + most + kMostLost, flags.data(), x1 - x0);
    std::uint64_t dark = 0;
    packFlags(flags.data(), x1 - x0, &dark);
    if (dark == 0) continue;
    contrast.fillStretches(lines, stretch, x0, x1, level.data());
    for (; dark != 0; dark &= dark - 1) {
      const int i = std::countr_zero(dark);
      const auto here = static_cast<float>(page.paper.at((x0 + i + 0.5) * page.shrink, (y + 0.5) * page.shrink));
      if (row[x0 + i] < here + level[i]) ink.row(y)[word] |= std::uint64_t{1} << i;
    }
  }
}

}  // namespace

BitImage inkOfPlane(const ShrunkenPage& page, const std::vector<float>& kernel, const RunContext& context) {
  BitImage ink(page.grey.width, page.grey.height);
  const RegionSurface contrast(page.contrasts, ink.width, ink.height, true);
  const Plane smoothed = smooth(page.grey, kernel, context);
  if (context.isCancelled()) return ink;
  parallelFor(context, ink.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) compareRowOfPlane(page, contrast, y, smoothed.row(y), ink);
  });
  return ink;
}

}  // namespace batten
