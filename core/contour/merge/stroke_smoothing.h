// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"
#include "core/contour/contour_set.h"

namespace batten {

/// Smooths the mean of overdrawn strokes. The mean has steps where strokes begin and end, which nobody drew. The line
/// is replaced by the one with the least change of curvature (third differences) that stays between the outermost
/// strokes; waves longer than `longestPx` are kept. Just beyond the end of a stroke the line may leave the remaining
/// strokes by less than half of the spread at that end, decreasing with distance. Where only one stroke was drawn the
/// line does not move.
/// @param points spacing of about one pixel.
/// @param bundle distances to the outermost strokes, one entry per point; if the sizes differ nothing moves.
/// @return the moved points, within the limits above.
std::vector<Vec2> fairWithinBundle(const std::vector<Vec2>& points, bool closed,
                                   const std::vector<BundleWidths>& bundle, double longestPx);

}  // namespace batten
