// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/contour_set.h"

namespace batten {

/// Multiplies all places and lengths of a line: it is the line on a page with `factor` times as many pixels along a
/// side.
void scaleContour(Contour&, double factor);
void scaleContours(ContourSet&, double factor);

}  // namespace batten
