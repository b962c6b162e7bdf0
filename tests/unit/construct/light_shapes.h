// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/curve/nurbs_curve.h"
#include "tests/support/dense_curve.h"
#include "tests/support/truth_shapes.h"

namespace batten::test {

/// Points of a curve at even steps of its parameter.
inline std::vector<Vec2> pointsOn(const NurbsCurve& curve, int count) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(curve.point(curve.start() + (curve.end() - curve.start()) * i / (count - 1)));
  }
  return points;
}

/// Largest distance of points from a polyline, tried against all of its edges: slow and without the program's own
/// search.
inline double farthestFrom(const std::vector<Vec2>& line, const std::vector<Vec2>& points) {
  double worst = 0.0;
  for (const Vec2& p : points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Vec2 edge = line[i] - line[i - 1], away = p - line[i - 1];
      const double square = edge.squaredNorm();
      const double along = square > 0.0 ? std::clamp(away.dot(edge) / square, 0.0, 1.0) : 0.0;
      nearest = std::min(nearest, (away - along * edge).squaredNorm());
    }
    worst = std::max(worst, std::sqrt(nearest));
  }
  return worst;
}

/// Curvature at even steps of the parameter, from the derivatives themselves.
inline std::vector<double> curvaturesOn(const NurbsCurve& curve, int count, bool closed) {
  std::vector<double> kappa;
  for (int i = 0; i < count - (closed ? 1 : 0); ++i) {
    const auto d = curve.derivatives(curve.start() + (curve.end() - curve.start()) * i / (count - 1), 2);
    kappa.push_back((d[1].x() * d[2].y() - d[1].y() * d[2].x()) / std::pow(d[1].norm(), 3));
  }
  return kappa;
}

}  // namespace batten::test
