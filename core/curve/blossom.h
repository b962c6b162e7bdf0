// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <type_traits>

#include "core/curve/nurbs_curve.h"

namespace batten {

/// The polar form (blossom) of the polynomial of a B-spline over [knot(span), knot(span + 1)] at `degree` arguments: de
/// Boor's algorithm with an argument of its own for each step. Exact for any arguments; symmetric in them.
/// @param knot, point  functions of an index; points may be of any vector space. @pre degree <= kMaxDegree.
template <class Knot, class Point>
auto blossom(int degree, const Knot& knot, const Point& point, int span, const double* arguments) {
  using Value = std::decay_t<decltype(point(0))>;
  std::array<Value, kMaxDegree + 1> d;
  for (int j = 0; j <= degree; ++j) d[j] = point(span - degree + j);
  for (int r = 1; r <= degree; ++r) {
    for (int j = degree; j >= r; --j) {
      const int i = span - degree + j;
      const double low = knot(i), high = knot(i + degree + 1 - r);
      const double share = (arguments[r - 1] - low) / (high - low);
      d[j] = (1.0 - share) * d[j - 1] + share * d[j];
    }
  }
  return d[degree];
}

}  // namespace batten
