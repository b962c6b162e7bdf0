// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/corners_inside.h"

#include <cmath>
#include <cstddef>

namespace batten {
namespace {

constexpr double kLeastCorner = 1e-3;  // [rad]

/// Directions of the control polygon's edges: equal points beside a place say nothing.
bool isBroken(const Vec2& before, const Vec2& after) {
  const double a = before.norm(), b = after.norm();
  if (!(a > 0.0) || !(b > 0.0)) return false;
  return std::abs(std::atan2(cross(before, after), before.dot(after))) > kLeastCorner;
}

}  // namespace

std::vector<double> cornersInside(const NurbsCurve& curve) {
  std::vector<double> found;
  if (curve.isEmpty()) return found;
  const auto knots = curve.knots();
  const auto points = curve.controlPoints();
  const int degree = curve.degree(), count = static_cast<int>(knots.size());
  for (int i = 0; i < count;) {
    int j = i;
    while (j < count && knots[j] == knots[i]) ++j;
    const double u = knots[i];
    // The curve passes through the control point before the last of `degree` equal knots.
    const int at = j - 1 - degree;
    if (j - i >= degree && u > curve.start() && u < curve.end() && at > 0 && at + 1 < curve.controlPointCount()) {
      const auto p = [&](int k) { return points[k]; };
      if (isBroken(p(at) - p(at - 1), p(at + 1) - p(at))) found.push_back(u);
    }
    i = j;
  }
  return found;
}

bool beginsAtCorner(const NurbsCurve& closed) {
  const auto p = closed.controlPoints();
  return p.size() > 2 && isBroken(p[p.size() - 1] - p[p.size() - 2], p[1] - p[0]);
}

}  // namespace batten
