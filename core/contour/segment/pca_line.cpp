// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/segment/pca_line.h"

#include <algorithm>
#include <cmath>

#include "core/contour/segment/regression_segments.h"

namespace batten {

PcaLine pcaLine(std::span<const Vec2> points) {
  PcaLine line;
  line.centroid = line.from = line.to = Vec2::Zero();
  line.direction = Vec2::UnitX();
  if (points.empty()) return line;
  const double n = static_cast<double>(points.size());
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : points) mean += p - points.front();  // relative, so that far from the origin nothing is lost
  line.centroid = points.front() + mean / n;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Vec2& p : points) {
    const Vec2 d = p - line.centroid;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  xx /= n, xy /= n, yy /= n;
  // Eigenvalues of the symmetric 2 x 2 matrix in closed form; the axis makes half the angle of (xx - yy, 2 xy).
  const double mean2 = 0.5 * (xx + yy), spread = std::hypot(0.5 * (xx - yy), xy);
  line.eigenvalueMajor = mean2 + spread;
  line.eigenvalueMinor = std::max(0.0, mean2 - spread);
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  line.direction = {std::cos(angle), std::sin(angle)};
  if (line.direction.dot(points.back() - points.front()) < 0.0) line.direction = -line.direction;
  double low = 0.0, high = 0.0, square = 0.0;
  for (const Vec2& p : points) {
    const Vec2 d = p - line.centroid;
    const double along = d.dot(line.direction), across = cross(line.direction, d);
    low = std::min(low, along);
    high = std::max(high, along);
    square += across * across;
  }
  line.from = line.centroid + low * line.direction;
  line.to = line.centroid + high * line.direction;
  line.residualRms = std::sqrt(square / n);
  return line;
}

}  // namespace batten
