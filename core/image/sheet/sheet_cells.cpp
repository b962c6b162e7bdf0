// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/sheet_cells.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/image/sheet/lanes_of_values.h"

namespace batten {
namespace {

constexpr double kPaperRankOfCell = 0.7;  // of the pixels of a cell by grey: ink is darker
constexpr int kSamplesAcross = 4;         // of a cell

constexpr std::int16_t stored(int value) { return static_cast<std::int16_t>(value - LanesOfValues::kMiddle); }

/// Pixels that lie `pitch` apart, and their differences from their neighbours at the right.
void takeEach(const std::uint16_t* __restrict at, std::ptrdiff_t pitch, int count, std::int16_t* __restrict levels,
              std::int16_t* __restrict steps) {
  for (int i = 0; i < count; ++i) {
    const int here = at[i * pitch], next = at[i * pitch + 1];
    levels[i] = stored(here);
    steps[i] = stored(std::abs(next - here));
  }
}

/// Some pixels of every cell of a row, and their differences from their neighbours at the right.
class CellSamples {
 public:
  CellSamples(const GreyImage& grey, const ColourImage& colour, int cellPx, int columns)
      : grey_(grey),
        colour_(colour),
        cellPx_(cellPx),
        columns_(columns),
        stride_(std::max(1, cellPx / kSamplesAcross)),
        levels_(columns),
        steps_(columns),
        lastSteps_(1) {}

  void take(int row) {
    for (LanesOfValues* values : {&levels_, &steps_, &lastSteps_}) values->clear();
    for (int y = row * cellPx_; y < (row + 1) * cellPx_; y += stride_) {
      for (int x = 0; x < cellPx_; x += stride_) addPlace(grey_.row(y), x);
    }
    row_ = row;
    darkest_ = levels_.leastOf();
    levels_.sortTo(paperRank());
    steps_.sortTo(steps_.count() / 2);
    lastSteps_.sortTo(lastSteps_.count() / 2);
  }

  /// Grey, red less grey and blue less grey of the paper.
  cv::Vec3f paper(int column) const {
    if (!colour_.isEmpty()) return colouredPaper(column);
    return {levelOf(levels_.value(paperRank(), column)), 0.0f, 0.0f};
  }
  /// [grey]
  float darkest(int column) const { return levelOf(darkest_[column] + LanesOfValues::kMiddle); }
  float roughness(int column) const {
    if (column + 1 < columns_) return levelOf(steps_.value(steps_.count() / 2, column));
    return levelOf(lastSteps_.value(lastSteps_.count() / 2, 0));
  }

 private:
  static float levelOf(int value) { return static_cast<float>(value / GreyImage::kGreyUnit); }
  int paperRank() const { return static_cast<int>(kPaperRankOfCell * (levels_.count() - 1.0)); }

  /// One pixel of each cell. At the border of the page the last cell may have no neighbour at the right.
  void addPlace(const std::uint16_t* row, int x) {
    std::int16_t *level = levels_.add(), *step = steps_.add();
    const int last = columns_ - 1;
    takeEach(row + x, cellPx_, last, level, step);
    const std::uint16_t* at = row + x + std::ptrdiff_t{last} * cellPx_;
    level[last] = stored(at[0]);
    step[last] = stored(0);  // lies in lastSteps_
    if (at + 1 < row + grey_.width) *lastSteps_.add() = stored(std::abs(at[1] - at[0]));
  }

  cv::Vec3f colouredPaper(int column) const {
    std::vector<std::pair<std::uint16_t, Rgb8>> coloured;
    for (int y = row_ * cellPx_; y < (row_ + 1) * cellPx_; y += stride_) {
      for (int x = column * cellPx_; x < (column + 1) * cellPx_; x += stride_)
        coloured.emplace_back(grey_.row(y)[x], colour_.row(y)[x]);
    }
    std::nth_element(coloured.begin(), coloured.begin() + paperRank(), coloured.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto& [grey, colour] = coloured[paperRank()];
    const float level = levelOf(grey);
    return {level, static_cast<float>(colour.red) - level, static_cast<float>(colour.blue) - level};
  }

  const GreyImage& grey_;
  const ColourImage& colour_;
  int cellPx_, columns_, stride_, row_ = 0;
  LanesOfValues levels_, steps_, lastSteps_;  ///< The last: of the last cell alone, those there are.
  std::vector<std::int16_t> darkest_;         ///< Stored as the values.
};

}  // namespace

SheetCells sheetCellsOf(const GreyImage& grey, const ColourImage& colour, const RunContext& context) {
  SheetCells cells;
  cells.hasTint = !colour.isEmpty();
  cells.sizePx = std::max(2, (std::max(grey.width, grey.height) + kSheetCells - 1) / kSheetCells);
  cells.columns = grey.width / cells.sizePx;
  cells.rows = grey.height / cells.sizePx;
  cells.colour.create(cells.rows, cells.columns);
  cells.rough.create(cells.rows, cells.columns);
  cells.dark.create(cells.rows, cells.columns);
  if (cells.colour.empty()) return cells;
  parallelFor(context, cells.rows, 8, [&](int begin, int end) {
    CellSamples samples(grey, colour, cells.sizePx, cells.columns);
    for (int j = begin; j < end; ++j) {
      samples.take(j);
      for (int i = 0; i < cells.columns; ++i) {
        cells.colour(j, i) = samples.paper(i);
        cells.rough(j, i) = samples.roughness(i);
        cells.dark(j, i) = samples.darkest(i);
      }
    }
  });
  cv::medianBlur(cells.colour, cells.colour, 3);
  return cells;
}

std::optional<cv::Point> cellAt(const SheetCells& cells, const Vec2& place) {
  const cv::Point at(cvRound(place.x()), cvRound(place.y()));
  const bool isInside = at.x >= 0 && at.y >= 0 && at.x < cells.columns && at.y < cells.rows;
  return isInside ? std::optional(at) : std::nullopt;
}

std::vector<float> levelsAlong(const SheetCells& cells, const Vec2& place, const Vec2& towards, const CellRange& at) {
  std::vector<float> levels;
  for (int d = at.from; d <= at.to; ++d)
    if (const auto cell = cellAt(cells, place + d * towards)) levels.push_back(cells.colour(*cell)[0]);
  return levels;
}

}  // namespace batten
