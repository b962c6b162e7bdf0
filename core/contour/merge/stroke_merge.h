// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// Makes one mean line of strokes that were drawn over one another: lines that run side by side within `distancePx`.
/// The nearest strokes are merged first, then ever wider bundles: so a line that comes near another and parts from it
/// is seen in full, and the two keep off each other. Every point moves to the mean of the strokes beside it; a stroke
/// counts less towards its ends and where it turns from the others, so that the mean has no jumps where strokes begin
/// and end. Where bundles meet, those go on as one line whose directions and places fit (stroke_net.h); overshoots go,
/// and a line that comes back to itself is closed. Where a bundle turns sharply, lines end and meet. The result is the
/// fairest line between the strokes (stroke_fair.h).
/// Contour::band of the result holds the strokes within the distance that run beside it. Lines without a neighbour stay
/// as they are, with a band of 0. About one point a pixel, also where strokes were joined: those points are not
/// refined. Not complete when cancelled.
std::vector<Contour> mergeStrokes(const std::vector<Contour>& lines, double distancePx, const RunContext& context);

}  // namespace batten
