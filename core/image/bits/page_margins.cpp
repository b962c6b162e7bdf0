// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/page_margins.h"

#include <algorithm>
#include <vector>

#include "core/image/bits/run_pieces.h"

namespace batten {

BitImage withoutMargins(BitImage ink, const RunContext& context) {
  constexpr int kTouchPx = 3;  // from the border
  struct Extent {
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0, rows = 0, columns = 0;  // rows and columns that touch
  };
  const RunPieces pieces = findPieces(ink, Connectivity::Eight, context);
  std::vector<Extent> extents(pieces.runs.size());
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const InkRun& run = pieces.runs[i];
    Extent& e = extents[pieces.piece[i]];
    if (pieces.piece[i] == static_cast<int>(i)) e = {run.x0, run.x1, run.y, run.y + 1, 0, 0};
    e = {std::min(e.x0, run.x0), std::max(e.x1, run.x1), e.y0, run.y + 1, e.rows, e.columns};
    if (run.x0 < kTouchPx || run.x1 > ink.width - kTouchPx) ++e.rows;
    if (run.y < kTouchPx || run.y >= ink.height - kTouchPx) e.columns = std::max(e.columns, run.x1 - run.x0);
  }
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const Extent& e = extents[pieces.piece[i]];
    if (2 * std::max(e.rows, e.columns) > std::max(e.x1 - e.x0, e.y1 - e.y0)) clearBits(ink, pieces.runs[i]);
  }
  return ink;
}

}  // namespace batten
