// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
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
  std::vector<Vec2> tangent;   ///< Unit direction of travel.
  std::vector<Source> source;  ///< The point of the line given that each came from.
  bool closed = false;
};

/// Every line with its points moved to the weighted mean of the lines that cross its normal within `distancePx`, in
/// three rounds. Weights fall towards the ends of a stroke, near the distance and with the angle between the strokes.
/// One per line, same order; not complete when cancelled. Same result with any number of threads.
std::vector<MeanLine> moveToMean(const std::vector<Contour>& lines, double distancePx, const RunContext& context);

/// Asks where strokes lay beside a line. Keeps its own copy of the strokes.
class StrokesBeside {
 public:
  StrokesBeside(const std::vector<Contour>& lines, double distancePx);
  ~StrokesBeside();
  /// The outermost strokes within `distancePx` that run along the line, the line itself being one: 0 to a side where
  /// none lies, and to both where they are no farther apart than one stroke scatters. Not complete when cancelled. Same
  /// result with any number of threads.
  StrokeBand band(const std::vector<Vec2>& points, bool closed, const RunContext& context) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace batten
