// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Cubic Bezier pieces in one go: the start, then two handles and an end per cubic.
struct CubicRun {
  Vec2 start = Vec2::Zero();
  std::vector<std::array<Vec2, 3>> cubics;

  const Vec2& end() const { return cubics.empty() ? start : cubics.back()[2]; }
};
/// A curve as cubics. More than one run only where the curve itself jumps, at a knot of multiplicity degree + 1.
struct CubicPath {
  std::vector<CubicRun> runs;
  double largestError = 0.0;  ///< Measured distance between the path and the curve, both ways, in the curve's unit.
  /// Measured jump of the curvature where two cubics meet, relative to the larger of the curve's curvature there and
  /// 0.05 / length of the curve. Places where the curve's own curvature may jump do not count. At most 0.016, unless a
  /// derivative of the curve vanishes.
  double largestJump = 0.0;
};

/// How near cubics are to be, and the unit of their coordinates. In the unit of the curve; tolerance > 4 grid > 0.
struct CubicTolerance {
  double tolerance = 0.0, grid = 0.0;
};

/// Cubics within `tolerance` of a curve, with its tangents and, but for 0.8 %, its curvatures at every joint, split by
/// halves where one cubic is not enough. Coordinates are rounded to multiples of `grid` (what the file will hold)
/// before anything is measured; ends stay ends.
Result<CubicPath> cubicPath(const NurbsCurve&, const CubicTolerance&, const RunContext& = {});

}  // namespace batten
