// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/corner/corner_suggestions.h"

namespace batten {

/// The corners to suggest on the lines of a drawing: what `suggestCorners` finds, and where the fair fit has to
/// cut a line from the start because it turns too sharply, by about the least angle or more. Image frame, px; arguments
/// as there. Not complete when cancelled.
std::vector<CornerSuggestion> suggestCornersAndCuts(const ContourSet&, double minAngleRad, double scalePx,
                                                    const RunContext&);

}  // namespace batten
