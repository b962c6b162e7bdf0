// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace batten {

/// Coefficients of the powers of t = u - start of a Bezier piece, from its control points: the k-th forward differences
/// times the binomial coefficients, over the k-th power of the width (Piegl & Tiller, The NURBS Book, 1.3).
/// @param points  control points or numbers: a vector or an array of them. @param width  of the piece in u.
template <class Points>
Points powersOfBezier(Points points, double width = 1.0) {
  const std::size_t count = points.size();
  for (std::size_t k = 1; k < count; ++k)
    for (std::size_t i = count; i-- > k;) points[i] = points[i] - points[i - 1];
  double factor = 1.0;
  for (std::size_t k = 0; k < count; ++k) {
    points[k] = factor * points[k];
    factor *= static_cast<double>(count - 1 - k) / static_cast<double>(k + 1) / width;
  }
  return points;
}

}  // namespace batten
