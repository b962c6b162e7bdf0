// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// Makes one mean line of strokes that were drawn over one another: lines that run side by side within `distancePx`.
/// Every point moves to the mean of the strokes beside it; a stroke counts less towards its ends, where it leaves the
/// others or turns from them, so that the mean has no jumps where strokes begin and end. What then lies on a longer
/// line is dropped, what goes on from its end is joined to it, and overshoots shorter than twice the distance go. The
/// result is the fairest line between the strokes (stroke_fair.h).
/// Contour::band of the result holds the strokes within the distance that run beside it. Lines without a neighbour stay
/// as they are, with a band of 0. About one point a pixel, also where strokes were joined: those points are not
/// refined. The order of the result is that of the lines that began it. Not complete when cancelled.
std::vector<Contour> mergeStrokes(const std::vector<Contour>& lines, double distancePx, const RunContext& context);

}  // namespace batten
