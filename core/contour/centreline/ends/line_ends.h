// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/contour_set.h"
#include "core/contour/subpixel/point_noise.h"
#include "core/polyline/point_grid.h"
#include "core/polyline/polyline_tools.h"

namespace batten {

/// A point of one of several lines.
struct PointOfLine {
  int line = 0, point = 0;
};

/// The points of all lines by cells of `cellPx`.
inline PointGrid<PointOfLine> gridOfLines(const std::vector<Contour>& lines, double cellPx) {
  PointGrid<PointOfLine> grid(cellPx);
  for (int i = 0; i < std::ssize(lines); ++i) {
    for (int k = 0; k < std::ssize(lines[i].points); ++k) grid.add(lines[i].points[k].at, {i, k});
  }
  return grid;
}

/// The k-th point of a line from its start (side 0) or its end (1).
inline const ContourPoint& pointFromEnd(const Contour& line, int side, int k) {
  return side == 0 ? line.points[k] : line.points[std::ssize(line.points) - 1 - k];
}

/// How a line runs up to its point `last` from an end, over `reach` px of arc length, which is 0 at that point and
/// negative before it. Of order 1, a straight line, where less than `leastShare` of the reach is seen.
inline LocalQuadratic fitBeforeEnd(const Contour& line, int side, int last, double reach, int order,
                                   double leastShare) {
  std::vector<double> s;
  std::vector<Vec2> points;
  double arc = 0.0;
  for (int k = last; k < std::ssize(line.points) && arc <= reach; ++k) {
    const Vec2& at = pointFromEnd(line, side, k).at;
    if (!points.empty()) arc += (at - points.back()).norm();
    s.push_back(-arc);
    points.push_back(at);
  }
  return fitLocalQuadratic(s, points, {}, arc >= leastShare * reach ? order : 1);
}

/// A point that was laid on beyond `before`, not measured.
inline ContourPoint laidPoint(const ContourPoint& before, const Vec2& at) {
  ContourPoint p = before;
  p.at = p.unrefined = at;
  p.refined = false;
  if (p.sigmaPx) p.sigmaPx = kGuessedSigmaPx;
  return p;
}

}  // namespace batten
