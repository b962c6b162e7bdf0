// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/corner/corner_suggestions.h"
#include "core/image/grey_image.h"

namespace batten {

/// The corners to suggest on the lines of a drawing: what `suggestCorners` finds, and where the fair fit has to
/// cut a line from the start because it turns too sharply, by about the least angle or more. Image frame, px; arguments
/// as there. Not complete when cancelled.
std::vector<CornerSuggestion> suggestCornersAndCuts(const ContourSet&, double minAngleRad, double scalePx,
                                                    const RunContext&);

/// The places among which certainCorners chooses, in the order of contours: turns of 28 degrees and more, over 14 px,
/// and of a pen's lines those of 40 degrees between shorter sides. Not complete when cancelled.
std::vector<CornerSuggestion> possibleCorners(const ContourSet&, const RunContext&);

/// The corners that count without a mark: the possible ones of kCertainCorner on lines found on the scan, on centre
/// lines only those that lie on ink. Of those near a refused place, within `reachPx`, the nearest is left out. Image
/// frame, px. Not complete when cancelled.
std::vector<Corner> certainCorners(const ContourSet&, const GreyImage& page, std::span<const Vec2> refusedPx,
                                   double reachPx, const RunContext&);

}  // namespace batten
