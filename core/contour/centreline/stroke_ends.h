// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/centreline/stroke_course.h"

namespace batten {

/// Puts the free ends where the middle of the pen was, half a width before the end of the ink.
void placeEnds(StrokeCourse& course, const GreyImage& grey);

Contour contourOf(const StrokeCourse& course);

}  // namespace batten
