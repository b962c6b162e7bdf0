// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/bits/run_pieces.h"

namespace batten {

/// A region of paper inside the ink.
struct InkHole {
  std::vector<InkRun> runs;  ///< In reading order.
  double widthPx = 0.0;      ///< Diameter of its largest disc, 0 until it is measured.
  int middleX = 0;           ///< [px] Of that disc.
  int middleY = 0;
};

/// The 4-connected regions of paper that reach no border of the page, in reading order; their widths are not measured
/// yet. None when cancelled.
std::vector<InkHole> findInkHoles(const BitImage& ink, const RunContext& context);

/// Measures the widths of holes in `ink`. Unfinished when cancelled.
void measureWidths(const BitImage& ink, std::vector<InkHole>& holes, const RunContext& context);

}  // namespace batten
