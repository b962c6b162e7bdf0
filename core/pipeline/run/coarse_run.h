// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/scan.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// By how much a page is made smaller, along both sides, so that a run on it takes a moment: 1 for pages of up to
/// 8 million pixels, else the least whole number that leaves at most 3 million.
int coarseFactor(int widthPx, int heightPx);
/// The same for a page with its recipe: 1, too, where the smaller page would have a resolution that no page may have.
int coarseFactor(const Scan&, const Recipe&);

/// The page with each square of `factor` px averaged to one px; what is left over at the right and the lower border is
/// dropped. Its resolution is that much lower, so that lengths in mm stay. Pixels averaged from a cancelled run are
/// white.
Scan coarsePage(const Scan&, int factor, const RunContext&);

/// The recipe for that page: places and lengths in px are divided by the factor, areas by its square, within the ranges
/// of the parameters; lengths in mm stay. `scan` is the full page, for its resolution.
Recipe coarseRecipe(Recipe recipe, const Scan& scan, int factor);

/// The frame in which curves of the coarse page lie on the full one.
PageFrame coarseFrame(const PageFrame& coarse, int factor);

}  // namespace batten
