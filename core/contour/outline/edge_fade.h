// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// A tone that fades behind its edge is fainter where levels are taken than at the edge itself, so that the place of
/// half the contrast is found too far outside. Measures the slopes of the grey on both sides beyond the edge, by and
/// by along the outline, and takes out what they do to the edge's position. Points that are not refined, or that see
/// another line or the end of the page there, take the slopes of their neighbours; without any nothing changes.
/// @pre blurPx of the outline is known. Not complete when cancelled.
void undoFade(Contour& outline, const GreyImage&, const RunContext&);

}  // namespace batten
