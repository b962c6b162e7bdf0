// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet_cells.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"

namespace batten {
namespace {

constexpr double kPaperRankOfCell = 0.7;  // of the pixels of a cell by grey: ink is darker
constexpr int kSheetCells = 400;          // along the longer side of the picture
constexpr int kSamplesAcross = 4;         // of a cell

/// Values so few that counting those below each of them beats sorting. Behind them lie ones that none exceeds.
struct FewValues {
  static constexpr int kMost = 64, kHalf = kMost / 2;
  std::array<std::int16_t, kMost> values;  ///< Less 32768.
  int count = 0;

  void clear() {
    values.fill(std::numeric_limits<std::int16_t>::max());
    count = 0;
  }
  void add(int value) { values[count++] = static_cast<std::int16_t>(value - 32768); }
};

/// The value that has `rank` smaller ones before it when sorted: the largest of those with no more than `rank` below.
BATTEN_HOT_LOOP int valueOfRank(const FewValues& few, int rank) {
  std::array<std::int16_t, FewValues::kMost> below{};
  const int lanes = few.count <= FewValues::kHalf ? FewValues::kHalf : FewValues::kMost;
  for (int j = 0; j < few.count; ++j) {
    const std::int16_t value = few.values[j];
    for (int i = 0; i < lanes; ++i) below[i] = static_cast<std::int16_t>(below[i] + (value < few.values[i] ? 1 : 0));
  }
  const auto most = static_cast<std::int16_t>(rank);
  std::int16_t found = std::numeric_limits<std::int16_t>::min();
  for (int i = 0; i < lanes; ++i) {
    const std::int16_t value = below[i] <= most ? few.values[i] : std::numeric_limits<std::int16_t>::min();
    found = value > found ? value : found;
  }
  return found + 32768;
}

/// Some pixels of a cell, and their differences from their neighbours at the right.
class CellSamples {
 public:
  void take(const GreyImage& grey, const ColourImage& colour, const cv::Rect& cell, int stride) {
    levels_.clear();
    darkest_ = std::numeric_limits<std::uint16_t>::max();
    steps_.clear();
    coloured_.clear();
    for (int y = cell.y; y < cell.y + cell.height; y += stride) {
      const std::uint16_t* row = grey.row(y);
      for (int x = cell.x; x < cell.x + cell.width; x += stride) {
        levels_.add(row[x]);
        darkest_ = std::min(darkest_, row[x]);
        if (!colour.isEmpty()) coloured_.emplace_back(row[x], colour.row(y)[x]);
        if (x + 1 < grey.width) steps_.add(std::abs(row[x + 1] - row[x]));
      }
    }
  }

  /// Grey, red less grey and blue less grey of the paper.
  cv::Vec3f paper() {
    const int rank = static_cast<int>(kPaperRankOfCell * (levels_.count - 1.0));
    if (coloured_.empty()) return {static_cast<float>(valueOfRank(levels_, rank) / GreyImage::kGreyUnit), 0.0f, 0.0f};
    std::nth_element(coloured_.begin(), coloured_.begin() + rank, coloured_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto& [grey, colour] = coloured_[rank];
    const auto level = static_cast<float>(grey / GreyImage::kGreyUnit);
    return {level, static_cast<float>(colour.red) - level, static_cast<float>(colour.blue) - level};
  }

  /// [grey]
  float darkest() const { return static_cast<float>(darkest_ / GreyImage::kGreyUnit); }
  float roughness() const { return static_cast<float>(valueOfRank(steps_, steps_.count / 2) / GreyImage::kGreyUnit); }

 private:
  FewValues levels_, steps_;
  std::uint16_t darkest_ = 0;
  std::vector<std::pair<std::uint16_t, Rgb8>> coloured_;
};

}  // namespace

SheetCells sheetCellsOf(const GreyImage& grey, const ColourImage& colour, const RunContext& context) {
  SheetCells cells;
  cells.sizePx = std::max(2, (std::max(grey.width, grey.height) + kSheetCells - 1) / kSheetCells);
  cells.columns = grey.width / cells.sizePx;
  cells.rows = grey.height / cells.sizePx;
  cells.colour.create(cells.rows, cells.columns);
  cells.rough.create(cells.rows, cells.columns);
  cells.dark.create(cells.rows, cells.columns);
  const int stride = std::max(1, cells.sizePx / kSamplesAcross);
  static_assert(2 * kSamplesAcross * 2 * kSamplesAcross <= FewValues::kMost);  // 2 kSamplesAcross - 1 at the most
  parallelFor(context, cells.rows, 8, [&](int begin, int end) {
    CellSamples samples;
    for (int j = begin; j < end; ++j) {
      for (int i = 0; i < cells.columns; ++i) {
        samples.take(grey, colour, cv::Rect(i * cells.sizePx, j * cells.sizePx, cells.sizePx, cells.sizePx), stride);
        cells.colour(j, i) = samples.paper();
        cells.rough(j, i) = samples.roughness();
        cells.dark(j, i) = samples.darkest();
      }
    }
  });
  cv::medianBlur(cells.colour, cells.colour, 3);
  return cells;
}

}  // namespace batten
