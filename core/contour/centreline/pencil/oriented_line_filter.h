// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/centreline/pencil/graininess.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// What means along lines in all directions tell about ink that was closed.
struct OrientedLines {
  /// Paper between parallel lines: the mean along some direction is clearly brighter than the means at both sides, and
  /// no direction is as dark as those. Grain within a line is not flanked by lines.
  BitImage gaps;
  /// Where a line continues: the means ahead and behind are both clearly darker than the sides.
  BitImage lines;
};
/// Searches `body` and its surroundings for lines about `widthPx` wide. The least contrast follows from grain and noise
/// at the place. Finds nothing for strokes wider than 24 px of the page. May throw std::bad_alloc. Not complete when
/// cancelled.
/// @param pixelsPerPx of body and grey, along a pixel of the page (fine_page.h).
OrientedLines filterOrientedLines(const BitImage& body, const GreyImage& grey, const GraininessMap& grain,
                                  double widthPx, const RunContext& context, int pixelsPerPx = 1);

}  // namespace batten
