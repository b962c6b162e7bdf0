// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Leads free ends of centre lines straight on over a little paper: to the line that an end points at, and of two ends
/// at an angle to where they would meet, as at the corner of a box drawn with four strokes. What is laid over paper is
/// a bridge of the line. Ends that face each other are those of one stroke (gaps.h).
/// @param longestWidths [stroke widths] of paper at most (EdgeParams::gapFactor), and never more than .75 or, with a
/// pencil, 2, nor a tenth of the line's length in all.
/// @param ink of the page on which the lines lie: what is not ink is paper.
void leadOverPaper(std::vector<Contour>& lines, const BitImage& ink, double longestWidths, const RunContext& context);

}  // namespace batten
