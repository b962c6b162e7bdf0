// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// Takes the wavering out of the mean of strokes that were drawn over one another. Where strokes begin and end their
/// mean jumps from one to the other, and how it does so was not drawn: the line becomes the one of least change of
/// curvature (third differences) that stays within a part of the band; waves longer than `longestPx` stay in any case.
/// Where only one stroke was drawn, away from the ends of others, the line stays where it is.
/// @param points about one a pixel; moved.
/// @param bandPx [px] half the spread of the strokes at every point; same size.
void fairWithinBand(std::vector<Vec2>& points, bool closed, const std::vector<float>& bandPx, double longestPx);

}  // namespace batten
