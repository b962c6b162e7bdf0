// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// The ink of a page, classified: every ink pixel is in exactly one of the two. All pictures have the size of the ink.
struct InkLabels {
  BitImage strokes;   ///< Lines of a pen, to be followed along their middle.
  BitImage shapes;    ///< Filled areas, dots and broad lettering, to be followed along their border.
  BitImage skeleton;  ///< Of all the ink.
  /// Of the strokes: where one swells that goes on without a step in width. Absent: nothing was looked for.
  std::optional<BitImage> swellings = {};
  /// [px] median width of the strokes, weighed by their lengths in widths; absent: there is none.
  std::optional<double> penPx = {};
};

/// Strokes and shapes, region by region: a solid and the lines attached to it are one piece of ink and two labels.
/// Pieces that are alike in size and width (an alphabet) are voted on together, so that broad-nib letters are shapes as
/// a whole. Nothing depends on the size of the page but what counts as a letter, and how wide a pen may be.
/// Strokes drawn over one another are no solid where they lie close: what is long, narrow and joined to three strokes,
/// or longer and joined to two, stays stroke; how narrow, the strokes that meet there say. So does what lines run into
/// without a step in width, if they cover far more than it does: a line that swells.
/// @param mergeWidths [stroke widths] how far apart the strokes of one line run that are to be merged; what is no wider
/// than such a line and joined to strokes is not a shape. 0: no merging.
/// @param pixelsPerPx of the ink, along a pixel of the page.
/// @return OutOfMemory, Cancelled.
Result<InkLabels> labelInk(const BitImage& ink, const RunContext&, double mergeWidths = 0.0, double pixelsPerPx = 1.0);

}  // namespace batten
