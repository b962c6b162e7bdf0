// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/base/run_context.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"
#include "core/image/rectification.h"

namespace batten {

struct FoundCorners {
  SheetCorners cornersPx;
  double bendPx = 0.0;  ///< How far the worst of the four edges bulges: lens distortion, or paper that is not flat.
};

/// The corners of a sheet to a part of a pixel, as the crossings of its four edges. Each edge is a straight line
/// through the places where grey or tint changes most from outside to inside; ink, things on the table and torn places
/// along it do not count.
/// @param roughPx where the corners lie to within `reachPx`.
/// @return UnreadableScan if an edge is not to be seen, with a message that names it.
Result<FoundCorners> sheetCorners(const GreyImage&, const ColourImage&, const SheetCorners& roughPx, double reachPx,
                                  const RunContext&);

/// Along which sides of a rectangle on the picture an edge of paper is seen within `reachPx`: upper, right, lower,
/// left. A drawn line is none: the paper goes on beyond it.
std::array<bool, 4> paperEdges(const GreyImage&, const ColourImage&, const SheetCorners&, double reachPx,
                               const RunContext&);

}  // namespace batten
