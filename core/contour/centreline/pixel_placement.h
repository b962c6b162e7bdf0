// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/stroke_course.h"
#include "core/image/grey_image.h"

namespace batten {

/// Last step of placing centre lines: moves every measured point to the middle between the two borders of the stroke
/// that make the raw pixels around it most likely. Half levels of interpolated profiles beat with the pixel grid (to
/// .08 px on unblurred pages); areas of pixels do not. A point that this would move by more than .3 px stays. The blur
/// of the light is one for the whole page.
void placeOnPixels(std::vector<StrokeCourse>& courses, const GreyImage& grey, const RunContext& context);

}  // namespace batten
