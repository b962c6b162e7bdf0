// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// Leads free ends of centre lines straight on over a little paper: to the line that an end points at, and of two ends
/// at an angle to where they would meet, as at the corner of a box drawn with four strokes. What is laid over paper is
/// a bridge of the line. Ends that face each other are those of one stroke (gaps.h).
/// @param longestWidths [stroke widths] of paper at most (EdgeParams::gapFactor), and never more than a pencil fades.
void leadOverPaper(std::vector<Contour>& lines, double longestWidths, const RunContext& context);

}  // namespace batten
