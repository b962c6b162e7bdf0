// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/curvature_jump.h"

#include <algorithm>
#include <cmath>

#include <optional>
#include <vector>
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

/// Curvature where a Bezier piece starts: (n - 1) / n of the distance of the third point from the end tangent over the
/// square of the first edge.
std::optional<double> curvatureAtStart(const Vec2& a, const Vec2& b, const Vec2& c, int degree) {
  const Vec2 first = b - a, second = c - b;
  const double speed = first.norm();
  if (!(speed > 0.0)) return std::nullopt;
  const double kappa = (degree - 1.0) / degree * cross(first, second) / (speed * speed * speed);
  return std::isfinite(kappa) ? std::optional(kappa) : std::nullopt;
}

}  // namespace

double largestCurvatureJump(const NurbsCurve& curve, bool closed) {
  const int degree = curve.degree();
  if (curve.isEmpty() || curve.isRational() || degree < 2) return 0.0;
  const auto pieces = bezierPieces(curve);
  if (!pieces || pieces->empty()) return 0.0;
  struct Ends {
    std::optional<double> start, end;
  };
  std::vector<Ends> ends;
  double largest = 0.0, jump = 0.0;
  for (const BezierPiece& piece : *pieces) {
    const auto& q = piece.controlPoints;
    const std::size_t n = q.size();
    Ends one{curvatureAtStart(q[0], q[1], q[2], degree), curvatureAtStart(q[n - 1], q[n - 2], q[n - 3], degree)};
    if (one.end) *one.end = -*one.end;
    for (const auto& kappa : {one.start, one.end}) largest = std::max(largest, std::abs(kappa.value_or(0.0)));
    ends.push_back(one);
  }
  for (std::size_t i = closed ? 0 : 1; i < ends.size(); ++i) {
    const auto& before = ends[(i + ends.size() - 1) % ends.size()].end;
    if (before && ends[i].start) jump = std::max(jump, std::abs(*ends[i].start - *before));
  }
  return largest > 0.0 ? jump / largest : 0.0;
}

}  // namespace batten
