// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// Moves the points of outline contours to where the raw grey values make the border between the local means of ink and
/// paper most likely: half level on profiles along the normal of the smoothed chain (search +-4 px), a blurred-edge
/// model for levels, blur and neighbouring borders, at last the pixels themselves, as areas (pixel_edge.h): no bias
/// that beats with the pixel grid. Where the profile is no edge the point stays on the crack and `refined` stays 0.
/// Points keep their number and order.
void refineOutline(Contour& contour, const GreyImage& grey, const RunContext&);

}  // namespace batten
