// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "core/base/vec2.h"

namespace batten {

struct Circle {
  Vec2 centre = Vec2::Zero();
  double radius = 0.0;  ///< [unit of the points]
};

/// The circle for which |p|^2 = 2 c.p + (r^2 - |c|^2) holds best by least squares, in the unit of the points (I. Kasa,
/// A circle fitting procedure and its error analysis, IEEE Trans. Instrum. Meas. 25, 1976). On a short arc with noise
/// its radius is too small: a start where that matters. Absent for fewer than three points and for points on a line.
/// @param weights one for each point, or none.
std::optional<Circle> algebraicCircle(std::span<const Vec2> points, std::span<const double> weights = {});

}  // namespace batten
