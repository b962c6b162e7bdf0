// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// A point of a line that is moved to the mean of the strokes beside it.
struct MeanPoint {
  struct Source {
    int line = 0, index = 0;  ///< Of the lines given; of its points.
  };
  Vec2 at = Vec2::Zero();       ///< [px]
  Vec2 tangent = Vec2::Zero();  ///< Unit direction of travel.
  Source source;                ///< The input point that it came from.
  float weight = 1.0f;          ///< About the number of strokes that it stands for.
};

/// A line that is moved to the mean of the strokes beside it.
struct MeanLine {
  std::vector<MeanPoint> points;
  bool closed = false;
  std::array<bool, 2> continues = {false, false};  ///< Another line continues at its start, at its end.
  int count() const { return static_cast<int>(points.size()); }
};
/// Copies of the positions, for the functions of core/polyline. [px]
std::vector<Vec2> positionsOf(const MeanLine&);
/// Moves the points and updates their tangents. @pre as many as the line has.
void setPositions(MeanLine&, const std::vector<Vec2>& positionsPx);

/// Moves every point to the weighted mean of the strokes that cross its normal within `distancePx`, in a few rounds. A
/// stroke weighs less towards its ends, towards the distance, and with the angle between the strokes. Two strokes that
/// are near each other over less than half of the shorter one and then part are separate lines and do not attract each
/// other. Not complete when cancelled. Same result with any number of threads.
void moveToMean(std::vector<MeanLine>& strokes, double distancePx, const RunContext& context);

/// Finds the strokes beside a line. Keeps its own copy of the strokes.
class StrokesBeside {
 public:
  StrokesBeside(const std::vector<Contour>& lines, double distancePx);
  ~StrokesBeside();
  /// Distances to the outermost strokes within `distancePx` that run along the line: 0 on a side without one, and on
  /// both sides if they are no farther apart than the scatter of a single stroke. Not complete when cancelled. Same
  /// result with any number of threads.
  /// @return one entry per point.
  std::vector<BundleWidths> bundle(const std::vector<Vec2>& points, bool closed, const RunContext& context) const;

  /// Whether another stroke, or a different part of the stroke `line` than that around point `index`, lies within
  /// `distancePx`.
  bool isNear(const Vec2& at, int line, int index) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace batten
