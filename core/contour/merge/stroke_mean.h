// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// A point of a line on its way to the mean of the strokes beside it.
struct MeanPoint {
  struct Source {
    int line = 0, index = 0;
  };
  Vec2 at = Vec2::Zero();       ///< [px]
  Vec2 tangent = Vec2::Zero();  ///< Unit direction of travel.
  Source source;                ///< The point of the line given that it came from.
  float weight = 1.0f;          ///< Of the strokes that it stands for, about their number.
};

/// A line on its way to the mean of the strokes beside it.
struct MeanLine {
  std::vector<MeanPoint> points;
  bool closed = false;
  std::array<bool, 2> continues = {false,
                                   false};  ///< Another line begins where this one starts, ends: no stroke's end.
  int count() const { return static_cast<int>(points.size()); }
};
/// Copies of the positions, for the functions of core/polyline. [px]
std::vector<Vec2> positionsOf(const MeanLine&);
/// Moves the points there and takes the directions of travel anew. @pre as many as the line has.
void setPositions(MeanLine&, const std::vector<Vec2>& positionsPx);

/// Moves the points of the strokes to the weighted mean of the strokes that cross their normals within `distancePx`, in
/// a few rounds. Weights fall towards the ends of a stroke, near the distance and with the angle between the strokes.
/// Strokes that come near each other and part again, for less than half of the shorter one, are two lines and keep
/// off each other. Not complete when cancelled. Same result with any number of threads.
void moveToMean(std::vector<MeanLine>& strokes, double distancePx, const RunContext& context);

/// Asks where strokes lay beside a line. Keeps its own copy of the strokes.
class StrokesBeside {
 public:
  StrokesBeside(const std::vector<Contour>& lines, double distancePx);
  ~StrokesBeside();
  /// The outermost strokes within `distancePx` that run along the line, the line itself being one: 0 to a side where
  /// none lies, and to both where they are no farther apart than one stroke scatters. Not complete when cancelled. Same
  /// result with any number of threads.
  /// @return one band a point.
  std::vector<StrokeBand> band(const std::vector<Vec2>& points, bool closed, const RunContext& context) const;

  /// Another stroke, or the stroke `line` itself on another way than through its point `index`, comes within
  /// `distancePx`.
  bool isNear(const Vec2& at, int line, int index) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace batten
