// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/centreline/profile/stroke_course.h"
#include "core/image/grey_image.h"

namespace batten {

/// Leads the last point of a course out to the tip, where its stroke thins to nothing. A threshold leaves off where
/// such a stroke is about a pixel wide, far from its tip; the darkness across it, summed up, goes on in proportion to
/// its width, and tells where it would be nothing. @return whether the stroke does thin so; else nothing is changed.
bool reachTaperTip(StrokeCourse& course, const GreyImage& grey);

}  // namespace batten
