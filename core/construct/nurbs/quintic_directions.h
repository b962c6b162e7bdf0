// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/vec2.h"

namespace batten {

/// Weights of the system below against the points.
struct DirectionWeights {
  double along = 0.3;        ///< Of the length of the first derivative: what uneven stations get wrong.
  double smoothness = 1e-3;  ///< Of the integral of |R'''|^2, without which lengths that are free collapse.
  bool pinEnds = false;      ///< The first and last point are met exactly.
};

/// Uniform quintic B-spline (knot spacing 1) that trusts the directions of its stations and less the lengths of their
/// derivatives: rows R = P and n.R' = 0 with weight 1, d.R' = magnitude with weight `along`, and the smoothness. For
/// stations of uneven distance, where uniform knots and full derivative rows make wiggles.
/// @return m + 4 control points. @pre sizes equal, m >= 4, directions of length 1.
Result<std::vector<Vec2>> solveQuinticDirections(std::span<const Vec2> points, std::span<const Vec2> directions,
                                                 std::span<const double> magnitudes, const DirectionWeights&);

}  // namespace batten
