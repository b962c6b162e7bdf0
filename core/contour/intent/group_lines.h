// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/intent/strip_mean.h"
#include "core/contour/intent/stroke_pieces.h"

namespace batten {

/// One line for every group: its pieces as they were traced where they follow each other, else their mean. Short ones
/// that lie along longer ones are left out. Not complete when cancelled.
std::vector<Contour> linesOfGroups(const std::vector<Contour>& lines, const StrokePieceSet& set,
                                   const PieceMeans& means, const std::vector<std::vector<int>>& groups, double widthPx,
                                   const RunContext& context);

}  // namespace batten
