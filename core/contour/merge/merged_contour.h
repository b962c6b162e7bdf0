// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/merge/stroke_mean.h"

namespace batten {

/// Turns a merged line into a contour: about one point a pixel, smoothed between the strokes beside it
/// (stroke_smoothing.h), with their bundle. Points between joined strokes, where none was drawn, are not refined.
/// @param lines the strokes that MeanPoint::source refers to. Not complete when cancelled.
Contour mergedContour(const MeanLine& line, const std::vector<Contour>& lines, const StrokesBeside& strokes,
                      double distancePx, const RunContext& context);

}  // namespace batten
