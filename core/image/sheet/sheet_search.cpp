// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/sheet_search.h"

#include "core/image/sheet/sheet_cells.h"

namespace batten {

SheetSearch searchSheet(const GreyImage& grey, const ColourImage& colour, const RunContext& context) {
  const SheetCells cells = sheetCellsOf(grey, colour, context);
  if (context.isCancelled()) return {};
  SheetSearch found{.cellPx = cells.sizePx, .holes = findBindingHoles(cells), .sheet = findPaperSheet(cells, context)};
  if (context.isCancelled()) return {};
  return found;
}

}  // namespace batten
