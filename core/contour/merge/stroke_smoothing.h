// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"
#include "core/contour/contour_set.h"

namespace batten {

/// Takes the wavering out of the mean of strokes that were drawn over one another. Where strokes begin and end their
/// mean jumps from one to the other, and how it does so was not drawn: the line becomes the one of least change of
/// curvature (third differences) between the outermost strokes; waves longer than `longestPx` stay in any case. Just
/// beyond the end of a stroke it may lie outside the others, by less than half of their spread there, fading away.
/// Where only one stroke was drawn, away from the ends of others, the line stays where it is.
/// @param points about one a pixel.
/// @param band where the strokes lie beside every point; of another size: nothing moves.
/// @return the points moved, never farther than the farther of the strokes beside it, or just beyond the end of one
/// than said above.
std::vector<Vec2> fairWithinBand(const std::vector<Vec2>& points, bool closed, const std::vector<StrokeBand>& band,
                                 double longestPx);

}  // namespace batten
