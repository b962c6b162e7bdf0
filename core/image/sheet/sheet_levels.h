// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// The median grey [0..65535] of every cell of a sheet, row by row; 0 outside it. Not complete when cancelled.
/// @param inside the cells of the sheet, each a square of cellPx pixels of the page.
std::vector<float> levelsOfCells(const GreyImage& page, const BitImage& inside, int cellPx, const RunContext& context);

/// Values that belong to the middles of cells, along a row of pixels: bilinear between the cells, constant beyond the
/// outermost middles.
class RowBetweenCells {
 public:
  /// @param values one a cell, row by row; must outlive this.
  RowBetweenCells(std::span<const float> values, int columns, int cellPx, int y);
  /// [as the values] At the centre of pixel x.
  double at(int x) const;

 private:
  std::span<const float> upper_, lower_;  ///< The rows of cells above and below.
  double share_ = 0.0;                    ///< Of the lower one.
  int cellPx_;
};

}  // namespace batten
