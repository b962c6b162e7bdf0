// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Where a stroke runs into a shape the shape has no border of its own: there the outline goes straight from rim to
/// rim, and the stretch is declared as a bridge. @param outline unrefined cracks. @param strokes the ink beside the
/// shapes.
void implyBorders(Contour& outline, const BitImage& strokes);

}  // namespace batten
