// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// Moves the points of an outline to the most likely position of the border between the local levels of ink and paper,
/// in three passes: half level on profiles along the normal of the smoothed chain (+-4 px); a blurred-edge model for
/// levels, blur and neighbouring borders; a model of pixel areas (pixel_edge.h), whose error does not repeat with the
/// pixel grid. Where the profile shows no edge the point stays on the crack and `refined` is false. Number and order of
/// the points stay.
void refineOutline(Contour& contour, const GreyImage& grey, const RunContext&);

}  // namespace batten
