// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/vec2.h"
#include "core/curve/foot_step.h"

namespace batten {

/// The control points of one cubic Bezier curve, parameter 0..1.
using CubicBezier = std::array<Vec2, 4>;

/// The place at t.
inline Vec2 cubicPoint(const CubicBezier& c, double t) {
  const double s = 1.0 - t;
  return s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3];
}
/// The first derivative with respect to the parameter.
inline Vec2 cubicFirst(const CubicBezier& c, double t) {
  const double s = 1.0 - t;
  return 3 * s * s * (c[1] - c[0]) + 6 * s * t * (c[2] - c[1]) + 3 * t * t * (c[3] - c[2]);
}
/// The second derivative with respect to the parameter.
inline Vec2 cubicSecond(const CubicBezier& c, double t) {
  return 6 * (1.0 - t) * (c[2] - 2.0 * c[1] + c[0]) + 6 * t * (c[3] - 2.0 * c[2] + c[1]);
}

/// The parameter of the foot of p that at most `rounds` steps (footStep) reach from t, within 0..1.
/// @param settled [parameter] a step no longer than this is the last one.
inline double cubicFoot(const CubicBezier& c, const Vec2& p, double t, int rounds, double settled = 0.0) {
  for (int i = 0; i < rounds; ++i) {
    const double next = std::clamp(t + footStep(cubicPoint(c, t) - p, cubicFirst(c, t), cubicSecond(c, t)), 0.0, 1.0);
    const bool isSettled = std::abs(next - t) <= settled;
    t = next;
    if (isSettled) break;
  }
  return t;
}

}  // namespace batten
