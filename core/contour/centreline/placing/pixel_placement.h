// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/profile/stroke_course.h"
#include "core/image/grey_image.h"

namespace batten {

/// Last step of placing centre lines: fits both borders of the stroke to the raw pixels around every measured point
/// (maximum likelihood) and moves the point to their middle. Half levels of interpolated profiles have an error that
/// repeats with the pixel grid (up to 0.08 px on unblurred pages); a model of pixel areas has none. A point that would
/// move by more than 0.3 px stays. One optical blur is fitted for the whole page.
void placeOnPixels(std::vector<StrokeCourse>& courses, const GreyImage& grey, const RunContext& context);

}  // namespace batten
