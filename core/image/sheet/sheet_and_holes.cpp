// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/sheet_and_holes.h"

#include <optional>
#include <utility>

#include "core/image/sheet/blank_margins.h"
#include "core/image/sheet/sheet_cells.h"

namespace batten {

SheetAndHoles findSheetAndHoles(const GreyImage& grey, const ColourImage& colour, const RunContext& context) {
  const SheetCells cells = sheetCellsOf(grey, colour, context);
  if (context.isCancelled()) return {};
  SheetAndHoles found{.holes = findBindingHoles(cells), .sheet = findPaperSheet(cells, context)};
  if (context.isCancelled()) return {};
  if (found.sheet) {
    std::optional<BindingHoles> along = findBindingHoles(cells, found.sheet->inside);
    if (along && (!found.holes || along->count > found.holes->count)) found.holes = std::move(along);
  }
  if (!found.sheet) found.sheet = sheetWithinMargins(grey);
  return found;
}

}  // namespace batten
