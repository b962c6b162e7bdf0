// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// Merges strokes drawn over one another, within `distancePx`, into one mean line. The nearest strokes are merged
/// first, then wider and wider bundles, so that two lines that approach and part are recognised and kept apart. Every
/// point moves to the mean of the strokes beside it (stroke_mean.h); a stroke weighs less towards its ends and where it
/// turns away, so that the mean does not jump where strokes begin and end. Where bundles meet, those with matching
/// directions continue as one line (piece_joining.h); overshoots are dropped, and a line that comes back to itself is
/// closed. At a sharp turn of a bundle lines end and meet. The result is smoothed between the outermost strokes
/// (stroke_smoothing.h), whose distances are the bundle of its points. Lines without a neighbour stay as they are, with
/// a bundle of 0. About one point a pixel; points between joined strokes are not refined. Not complete when cancelled.
std::vector<Contour> mergeStrokes(const std::vector<Contour>& lines, double distancePx, const RunContext& context);

}  // namespace batten
