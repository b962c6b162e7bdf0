// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "core/base/vec2.h"

namespace batten {

/// The distance's second derivative is trusted down to this share of that of a straight line; below it the point lies
/// near the centre of curvature or beyond it.
inline constexpr double kFootTrust = 0.2;

/// The step of the parameter from a place of a curve towards the foot of a point, the place where (C - p) . C' = 0:
/// Newton's on half the squared distance, or where its second derivative is not clearly positive Gauss and Newton's,
/// which always goes downhill. Piegl & Tiller, The NURBS Book, section 6.1. @param offset C - p. @param second zero:
/// Gauss and Newton's step. @return 0 where the curve stands still or is not finite.
inline double footStep(const Vec2& offset, const Vec2& first, const Vec2& second) {
  const double speed2 = first.squaredNorm();
  const double bend = speed2 + offset.dot(second);
  const double step = -offset.dot(first) / (bend > kFootTrust * speed2 ? bend : speed2);
  return std::isfinite(step) ? step : 0.0;
}

}  // namespace batten
