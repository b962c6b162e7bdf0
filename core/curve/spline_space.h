// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// The B-splines of one degree with a knot at every place, at any distances: open ones run on beyond both ends at the
/// distance of the outermost places, closed ones come round again. UniformKnots (uniform_quintic.h) is the faster one
/// where all distances are equal.
struct SplineSpace {
  int degree = 5;
  std::vector<double> places;  ///< Increasing; closed: one more, where the first point comes again.
  std::vector<double> knots;   ///< Unclamped.
  bool closed = false;
  int unknowns = 0;  ///< Control points that differ.
  int count = 0;     ///< Control points of the unclamped curve.

  /// The basis functions at u with their derivatives up to `order`; of closed curves control point j is j modulo
  /// `unknowns`.
  BasisRow row(double u, int order) const { return basis(degree, knots, count, u, order); }
  /// Control points of the unclamped curve from those that differ: periodic ones begin again.
  std::vector<Vec2> unrolled(const std::vector<Vec2>& controlPoints) const;
};

/// @pre open: 2 places or more; closed: more than the degree.
SplineSpace splineSpace(int degree, std::vector<double> places, bool closed);

/// Places 0, 1, 2 ... for so many points, closed ones with the place where the first comes again.
std::vector<double> uniformPlaces(std::size_t points, bool closed);

}  // namespace batten
