// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/bit_image.h"

namespace batten {

/// The ink of a page, told apart: every pixel of ink is in one of the two. All pictures have the size of the ink.
struct InkLabels {
  BitImage strokes;    ///< Lines of a pen, to be followed along their middle.
  BitImage shapes;     ///< Filled areas, dots and broad lettering, to be followed along their border.
  BitImage skeleton;   ///< Of all the ink.
  double penPx = 0.0;  ///< [px] median width of the strokes, weighed by their lengths in widths; 0: there is none.
};

/// Strokes and shapes, region by region: a solid and the lines attached to it are one piece of ink and two labels.
/// Pieces that are alike in size and width (an alphabet) are voted on together, so that broad-nib letters are shapes as
/// a whole. Nothing depends on the size of the page but what counts as a letter.
/// @return OutOfMemory, Cancelled.
Result<InkLabels> labelInk(const BitImage& ink, const RunContext&);

}  // namespace batten
