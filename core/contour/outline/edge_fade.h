// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// Corrects the position of edges whose tone fades behind the edge: there the levels are fainter than at the edge
/// itself, and the half level is found too far outside. Measures the slope of the grey on both sides beyond the edge,
/// smoothed along the outline, and subtracts its effect on the position. Points that are not refined, or that see
/// another line or the end of the page there, take the slopes of their neighbours.
/// @pre blurPx of the outline is known. Not complete when cancelled.
void undoFade(Contour& outline, const GreyImage&, const RunContext&);

}  // namespace batten
