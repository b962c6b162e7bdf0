// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// A line on its way to the mean of the strokes beside it.
struct MeanLine {
  struct Source {
    int line = 0, index = 0;
  };
  std::vector<Vec2> points;
  std::vector<Vec2> tangent;  ///< Unit direction of travel.
  /// [px] Where along the left normal the strokes lay that are this line now; the line's own one to begin with.
  std::vector<float> low, high;
  std::vector<Source> source;  ///< The point of the line given that each came from.
  bool closed = false;
};

/// Every line with its points moved to the weighted mean of the lines that cross its normal within `distancePx`, in
/// three rounds. Weights fall towards the ends of a stroke, near the distance and with the angle between the strokes.
/// One per line, same order; not complete when cancelled. Same result with any number of threads.
std::vector<MeanLine> moveToMean(const std::vector<Contour>& lines, double distancePx, const RunContext& context);

}  // namespace batten
