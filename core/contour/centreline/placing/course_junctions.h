// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/centreline/profile/stroke_course.h"

namespace batten {

/// Marks where a stroke is blotted, for a stretch of a few widths that is broad at once and as narrow again, as a
/// junction: the middle of a blot is not the way the pen took. A stroke that swells over a longer stretch, that ends in
/// a blot or turns there keeps its middle.
void hideBlots(StrokeCourse& course);

/// Replaces the points within junctions by a cubic that continues both sides.
void layThroughJunctions(StrokeCourse& course);

/// Lays a cubic over places where a course steps aside within a width or two and goes on as before: no pen turns and
/// turns back within its own width. They come from a border that jumps, where a stroke was set on anew or the ink of
/// two begins.
void removeJogs(StrokeCourse& course);

}  // namespace batten
