// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace batten {

/// Between the two values beside `place`, where values stand at the whole numbers from 0 on; beyond the last ones their
/// straight line goes on. @pre two values or more.
inline double linearBetween(const std::vector<double>& values, double place) {
  const double below = std::clamp(std::floor(place), 0.0, static_cast<double>(values.size()) - 2.0);
  const int i = static_cast<int>(below);
  return values[i] + (place - below) * (values[i + 1] - values[i]);
}

/// Between two values, 0..1 of the way; exact at both ends.
struct ExactBetween {
  double operator()(double a, double b, double share) const { return std::lerp(a, b, share); }
};
/// But for the last bit the same, without branches: for whoever reads every pixel.
struct FastBetween {
  double operator()(double a, double b, double share) const { return a + share * (b - a); }
};

/// A place among values that stand at whole columns and rows from 0 on; from outside it is moved to the nearest of
/// them.
/// @pre a column and a row or more.
template <typename Real = double>
struct BilinearPlace {
  int left, right, upper, lower;  ///< The columns and rows beside it.
  Real across, down;              ///< 0..1 of the way from the left and the upper ones.

  BilinearPlace(int columns, int rows, Real u, Real v) {
    u = std::clamp(u, Real{0}, static_cast<Real>(columns - 1));
    v = std::clamp(v, Real{0}, static_cast<Real>(rows - 1));
    left = static_cast<int>(u), upper = static_cast<int>(v);
    right = std::min(left + 1, columns - 1), lower = std::min(upper + 1, rows - 1);
    across = u - static_cast<Real>(left), down = v - static_cast<Real>(upper);
  }
  /// @param value of a column and a row.
  template <typename Value, typename Between = ExactBetween>
  Real of(const Value& value, const Between& between = {}) const {
    const Real above = between(value(left, upper), value(right, upper), across);
    const Real below = between(value(left, lower), value(right, lower), across);
    return between(above, below, down);
  }
};

}  // namespace batten
