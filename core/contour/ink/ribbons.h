// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Of `fillings`, those that are most of the ink about as wide as where they lie, as far as some of its widths around,
/// and those beside shapes, which go on in them. Where a line runs through a ribbon of ink, what it leaves out in
/// places is no thing by itself.
/// @param strokes the ink that the fillings are of.
BitImage fillingsOfRibbons(const BitImage& fillings, const BitImage& strokes, const BitImage& shapes,
                           const ContourSet& lines, const RunContext&);

}  // namespace batten
