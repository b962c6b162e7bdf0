// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/vec2.h"
#include "core/contour/contour_set.h"

namespace batten::test {

/// A centre line through the points [px], of one stroke width [px] everywhere, every point located.
inline Contour centreline(const std::vector<Vec2>& points, bool closed, double widthPx) {
  Contour line;
  line.kind = ContourKind::Centreline;
  line.closed = closed;
  line.points = contourPoints(points, true);
  for (ContourPoint& p : line.points) p.widthPx = static_cast<float>(widthPx);
  measureContour(line);
  return line;
}

/// About a point a pixel along a polygon; its last corner ends it, or of a closed one leads back to the first.
inline std::vector<Vec2> alongPolygon(std::vector<Vec2> corners, bool closed) {
  if (closed) corners.push_back(corners.front());
  std::vector<Vec2> points;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 way = corners[i + 1] - corners[i];
    const int steps = std::max(1, static_cast<int>(std::lround(way.norm())));
    for (int k = 0; k < steps; ++k) points.push_back(corners[i] + way * (static_cast<double>(k) / steps));
  }
  if (!closed) points.push_back(corners.back());
  return points;
}

}  // namespace batten::test
