// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/contour/centreline/ends/end_shape.h"
#include "core/contour/centreline/profile/stroke_course.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// A free end of a stroke, looked at but not placed yet.
struct FreeEnd {
  EndCourse course;
  int inside = 0;        ///< Points from the anchor of its course to the last one.
  double widthPx = 1.0;  ///< [px] of the stroke.
  double tipPx = 0.0;    ///< [px] beyond the anchor: the end of the ink.
  std::optional<PenStop> stop;
};
/// At the start and at the end of a course; absent where it does not end freely or is placed already.
using FreeEnds = std::array<std::optional<FreeEnd>, 2>;

/// Follows the ink beyond the ends of a course, to the tip where it thins to nothing, and looks at the ends elsewhere.
/// A pencil fades where a pen thins: its line goes no farther than it is seen.
FreeEnds findEnds(StrokeCourse& course, const GreyImage& grey, bool isPencil);

/// How much likelier an end is cut off than round, by all ends of strokes made by the same pen: natural logarithm of
/// the odds. One end of a thin stroke does not tell; together they do.
double cutOddsOf(const std::vector<FreeEnds>& ends);

/// Puts the free ends where the pen was lifted: on the edge where the ink is cut off, and in the centre of a round end,
/// half a width before the end of the ink.
void placeEnds(StrokeCourse& course, const FreeEnds& ends, double cutOdds);

/// The course as a line of the drawing, without points that run back or nearly coincide.
Contour contourOf(const StrokeCourse& course);

}  // namespace batten
