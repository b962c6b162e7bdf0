// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/paint_over.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/push_pull.h"
#include "core/image/sheet/facing_pages.h"
#include "core/image/sheet/paper_sheet.h"
#include "core/image/sheet/sheet_levels.h"

namespace batten {
namespace {

/// A whole number from 0 to 255 * 4 that looks random, the same for the same pixel.
int grainAt(int x, int y) {
  auto h = static_cast<std::uint32_t>(x) * 0x9E3779B1u ^ static_cast<std::uint32_t>(y) * 0x85EBCA77u;
  h ^= h >> 15;
  h *= 0x2C1B3C6Du;
  h ^= h >> 12;
  h *= 0x297A2D39u;
  h ^= h >> 15;
  return static_cast<int>((h & 255u) + (h >> 8 & 255u) + (h >> 16 & 255u) + (h >> 24));
}
constexpr double kGrainMean = 510.0, kGrainSigma = 147.8;  // of four bytes added

}  // namespace

GreyImage onlyTheSheet(const GreyImage& page, const PaperSheet& sheet, const RunContext& context) {
  std::optional<GreyImage> even = pagesOnOneLevel(page, sheet.inside, sheet.cellPx, context);
  if (!even) return paintedOver(page, sheet.inside, sheet.cellPx, context);
  return paintedOver(std::move(*even), sheet.inside, sheet.cellPx, context);
}

GreyImage paintedOver(GreyImage out, const BitImage& inside, int cellPx, const RunContext& context) {
  const int columns = inside.width, rows = inside.height;
  std::vector<float> level = levelsOfCells(out, inside, cellPx, context), weight(level.size(), 0.0f);
  std::vector<float> steps;
  for (int j = 0; j < rows && !context.isCancelled(); ++j) {
    const std::uint16_t* row = out.row(j * cellPx);
    for (int i = 0; i < columns; ++i) {
      if (!inside.at(i, j)) continue;
      const std::uint16_t* first = row + i * cellPx;
      steps.push_back(static_cast<float>(first[1] - first[0]));
      weight[std::ptrdiff_t{j} * columns + i] = 1.0f;
    }
  }
  if (steps.empty() || context.isCancelled()) return out;
  const double grain = robustSigma(steps) / std::sqrt(2.0);
  // Ink within the sheet must not bleed out of it: darker cells than around do not count.
  constexpr float kNoDarker = 0.97f;  // times the mean around; with ink over a twentieth of it a cell is darker
  constexpr int kAroundCells = 31;    // 15 to either side
  const std::vector<float> first = pushPull(level, weight, columns, rows);
  cv::Mat1f smooth(rows, columns, const_cast<float*>(first.data())), around;
  cv::blur(smooth, around, {kAroundCells, kAroundCells}, {-1, -1}, cv::BORDER_REPLICATE);
  for (std::size_t i = 0; i < level.size(); ++i) {
    if (level[i] < kNoDarker * around(static_cast<int>(i) / columns, static_cast<int>(i) % columns)) weight[i] = 0.0f;
  }
  const std::vector<float> paper = pushPull(level, weight, columns, rows);
  parallelFor(context, out.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const RowBetweenCells row(paper, columns, cellPx, y);
      const int cellRow = std::min(y / cellPx, rows - 1);
      for (int x = 0; x < out.width; ++x) {
        if (inside.at(std::min(x / cellPx, columns - 1), cellRow)) continue;
        const double noise = grain * (grainAt(x, y) - kGrainMean) / kGrainSigma;
        out.row(y)[x] = static_cast<std::uint16_t>(std::clamp(row.at(x) + noise, 0.0, 65535.0));
      }
    }
  });
  return out;
}

}  // namespace batten
