// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// Moves the points of outline contours to the half level between the local means of ink and paper, measured on the raw
/// grey values along the normal of the smoothed chain (search +-4 px, two passes). Where the profile is no edge the point
/// stays on the crack and `refined` stays 0. Points keep their number and order.
void refineOutline(Contour& contour, const GreyImage& grey, const RunContext&);

}  // namespace batten
