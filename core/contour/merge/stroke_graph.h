// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/merge/overlap_removal.h"

namespace batten {

/// The lines that the pieces were meant to be. Where pieces meet, those go on as one whose places, directions and bends
/// fit; what is left over there and no longer than twice `distancePx` was an overshoot and goes. Lines that share a
/// short way go on at its other end as they came. Free ends that look at each other within the distance are joined,
/// and a line is closed where it meets itself. A single stroke that leaves the others smoothly and ends is an overshoot
/// for longer than a bundle is. `widestPx` is the distance within which strokes will be one in the end. Not complete
/// when cancelled.
std::vector<MeanLine> joinPieces(StrokePieces pieces, double distancePx, double widestPx, const RunContext& context);

}  // namespace batten
