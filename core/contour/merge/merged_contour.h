// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/merge/stroke_mean.h"

namespace batten {

/// The contour that a line of joined strokes makes: about one point a pixel, made fair between the strokes beside it
/// (stroke_fair.h), with the band in which they lie. Points where strokes were joined and none was drawn are not
/// refined.
/// @param lines the strokes that the line's sources refer to. Not complete when cancelled.
Contour mergedContour(const MeanLine& line, const std::vector<Contour>& lines, const StrokesBeside& strokes,
                      double distancePx, const RunContext& context);

}  // namespace batten
