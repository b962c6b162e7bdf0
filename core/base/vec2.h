// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/base/angle.h"

namespace batten {

/// A point or vector of the plane. Which frame it lives in (image px, y down, or model mm, y up) is said by the name or
/// the comment of whatever holds it; see conventions.h. Only PageFrame converts between the two.
using Vec2 = Eigen::Vector2d;

/// z component of a x b: positive when b lies to the left of a in a frame with y up.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// [deg] 0..180 between two directions.
inline double turnDeg(const Vec2& a, const Vec2& b) { return std::atan2(std::abs(cross(a, b)), a.dot(b)) * kDegPerRad; }

/// `v` turned by +90 degrees in a frame with y up: the left normal of a direction.
inline Vec2 leftNormal(const Vec2& v) { return {-v.y(), v.x()}; }

}  // namespace batten
