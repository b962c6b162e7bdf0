// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/image/threshold/paper_fold.h"

namespace batten {

/// The paper's grey on a coarse grid: cell (i, j) is centred at px ((i + .5) * cellPx, (j + .5) * cellPx); between
/// centres bilinear, beyond them constant. Empty when flattening is off.
struct PaperBackground {
  int cellPx = 8;  ///< [px] Side of a cell.
  int columns = 0;
  int rows = 0;
  std::vector<float> grey;       ///< [grey 0..255] columns * rows.
  std::vector<PaperFold> folds;  ///< Steps that come on top: folds and edges of shadows.
  bool isEmpty() const { return grey.empty(); }
  /// Paper level at an image position; 255 when empty.
  double at(double xPx, double yPx) const;
};

}  // namespace batten
