// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/corner/corner_suggestions.h"

namespace batten {

/// Certain corners of strokes whose sides are short, as of a small box, a zigzag or a letter: beside them
/// suggestCorners() looks past the next corner. A side is the straight line through what the ink of its corners leaves
/// free of it. The unit of length is the width of the stroke, 3 px at least. Sides that bend, and turns of less than 40
/// degrees, are left to suggestCorners(). Not complete when cancelled.
/// @param known what that has found; places of certain ones are not returned again.
std::vector<CornerSuggestion> cornersOfShortSides(const ContourSet&, std::span<const CornerSuggestion> known,
                                                  const RunContext&);

}  // namespace batten
