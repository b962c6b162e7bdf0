// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/vec2.h"
#include "core/contour/corner/corner_sides.h"
#include "core/image/grey_image.h"

namespace batten {

/// Probability that two standard normal variables of this correlation lie below h and k (Drezner and Wesolowsky, J.
/// Statist. Comput. Simul. 35, 1990). Error < 1e-4 for |correlation| <= .99.
double bothBelow(double h, double k, double correlation);

/// Lets the raw pixels around the corner of an outline, whose points are of no use there because the edge of one side
/// is blurred into the other's, correct the two sides that lead to it: a wedge of ink or of paper, blurred, fitted by
/// most likely position with what the sides know of themselves beforehand (iterated Kalman filter).
/// @param sides against and along the contour; ink lies to the left normal of travel (y down).
/// @param blurPx standard deviation of the light's blur, without the pixels' own.
/// @return the corrected sides; absent where there are no two tones or where the pixels show something else.
std::optional<CornerSides> fitCornerToPixels(const GreyImage& grey, const Vec2& corner, double blurPx,
                                             CornerSides sides);

}  // namespace batten
