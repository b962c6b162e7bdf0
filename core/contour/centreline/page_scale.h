// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/centreline/stroke_path.h"
#include "core/contour/contour_set.h"

namespace batten {

/// Multiplies all places and lengths of a line: it is the line on a page with `factor` times as many pixels along a
/// side.
void scaleContour(Contour&, double factor);
void scaleContours(ContourSet&, double factor);

/// Stroke paths that were found on a fine page (fine_page.h), on the page: about one point a pixel.
std::vector<StrokePath> fromFinePage(const std::vector<StrokePath>&);

}  // namespace batten
