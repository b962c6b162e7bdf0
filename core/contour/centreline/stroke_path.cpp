// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/stroke_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kForwardCos = 0.2;  // 78 degrees: a direction that points away by more looks back

/// [px] Twice the median; at least 1, and 1 of none.
double twiceMedian(std::vector<float> radii) {
  return radii.empty() ? 1.0 : std::max(1.0, 2.0 * static_cast<double>(upperMedian(radii)));
}

}  // namespace

double StrokePath::length() const { return strokePathLength(points, closed); }

double StrokePath::widthPx() const {
  std::vector<float> radii;
  for (const StrokePathPoint& p : points) radii.push_back(p.radius);
  return twiceMedian(std::move(radii));
}

double strokePathLength(const std::vector<StrokePathPoint>& points, bool closed) {
  double sum = 0.0;
  for (int i = 1; i < std::ssize(points); ++i) sum += (points[i].at - points[i - 1].at).norm();
  if (closed && points.size() > 1) sum += (points.front().at - points.back().at).norm();
  return sum;
}

double medianWidth(const std::vector<StrokePath>& paths, const std::function<bool(int)>& isChosen) {
  std::vector<float> radii;
  for (int i = 0; i < std::ssize(paths); ++i) {
    if (!isChosen(i)) continue;
    for (const StrokePathPoint& p : paths[i].points) radii.push_back(p.radius);
  }
  return twiceMedian(std::move(radii));
}

// An arc that turns by phi has its derivative 4 tan(phi / 4) r and the chord 2 sin(phi / 2) r. Of more than half a turn
// the directions alone would not tell it from less.
double endDerivative(double chord, const Vec2& fromDirection, const Vec2& toDirection) {
  const double cosPhi = std::clamp(fromDirection.dot(toDirection), -1.0, 1.0);
  const double cosHalf = std::sqrt(0.5 * (1.0 + cosPhi));
  return chord / (0.5 * (1.0 + cosHalf));
}

std::vector<Vec2> cubicBetween(const Vec2& from, const Vec2& fromDirection, const Vec2& to, const Vec2& toDirection) {
  const Vec2 d = to - from;
  const double length = d.norm();
  const int steps = static_cast<int>(std::lround(length));
  std::vector<Vec2> points;
  const double derivative = endDerivative(length, fromDirection, toDirection);
  // A direction that looks back would fold the line: go straight there.
  const bool fair = fromDirection.dot(d) > kForwardCos * length && toDirection.dot(d) > kForwardCos * length;
  for (int k = 1; k < steps; ++k) {
    const double t = static_cast<double>(k) / steps, u = 1.0 - t;
    if (fair) {
      points.push_back(u * u * (1.0 + 2.0 * t) * from + t * t * (1.0 + 2.0 * u) * to +
                       derivative * t * u * (u * fromDirection - t * toDirection));
    } else {
      points.push_back(u * from + t * to);
    }
  }
  return points;
}

}  // namespace batten
