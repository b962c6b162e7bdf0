// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// A sharp corner that a line has at some scale.
struct ScaleCorner {
  int sample = 0;              ///< Of the line, where it turns most.
  Vec2 vertex = Vec2::Zero();  ///< Where the two sides meet, or where the line is nearest to that.
  double turnRad = 0.0;        ///< [rad] over two scales to either side; positive to the left.
  bool hard = false;           ///< It also turns at large; else it is a notch.
};

/// A line as points at even steps, about a twelfth of the scale.
struct EvenLine {
  std::vector<Vec2> points;  ///< Closed: the first is not repeated.
  bool closed = false;
  double step = 0.0;  ///< [unit of the line]

  int size() const { return static_cast<int>(points.size()); }
};
EvenLine evenLine(const NurbsCurve&, bool closed, double step);

/// Cuts off spikes, inlets and loops that are thinner than the scale: between two points nearer than .8 of it, with a
/// line between them of more than 3 mouths and 2 scales and of at most 16 scales; the longest first. @return how many.
int cutNecks(EvenLine&, double scale, const RunContext&);

/// Corners of a line that are sharp within `scale`, in order along it: its direction, smoothed over half a scale, turns
/// by 25 degrees and more within two scales, while the line to either side bends far less, and the sides meet within a
/// scale of the line: a rounding of radius r passes the vertex of a turn phi at r (sec(phi / 2) - 1). Of two within 3.4
/// scales that turn the same way the harder one is kept.
std::vector<ScaleCorner> cornersAtScale(const EvenLine&, double scale);

}  // namespace batten
