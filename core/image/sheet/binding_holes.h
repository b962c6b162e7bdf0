// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/image/bits/bit_image.h"

namespace batten {

struct SheetCells;

/// The holes, or the wires, of a spiral or comb binding.
struct BindingHoles {
  int cellPx = 1;  ///< [px] What one pixel of `cells` covers a side.
  BitImage cells;  ///< Holes and their rims, and the edge of the sheet beside them; of the size of the cells.
  int count = 0;   ///< Holes, or wires.
};

/// Finds a row of at least eight dark holes of one size at one distance, straight along one side of the page and near
/// it, in a margin that is empty otherwise but where a drawing reaches it: letters have others beside them all along.
/// What joins them along the side, as the edge of the sheet or a shadow, does not count. Absent where two sides have
/// such a row: that is a frame that was drawn or printed.
std::optional<BindingHoles> findBindingHoles(const SheetCells& cells);

/// The same along the straight sides of a sheet that fills a part of the picture, however it lies.
/// @param sheet the cells of the sheet.
std::optional<BindingHoles> findBindingHoles(const SheetCells& cells, const BitImage& sheet);

}  // namespace batten
