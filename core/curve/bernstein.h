// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace batten {

inline constexpr int kMostBernsteinDegree = 7;  // the highest degree of a curve (kMaxDegree)

/// The Bernstein polynomials of a degree at a place 0..1, in order; 0 behind them. @pre 0 <= degree <= 7.
inline std::array<double, kMostBernsteinDegree + 1> bernsteinPolynomials(int degree, double at) {
  std::array<double, kMostBernsteinDegree + 1> values{};
  values[0] = 1.0;
  for (int d = 1; d <= degree; ++d)
    for (int k = d; k >= 0; --k)
      values[k] = (k < d ? (1.0 - at) * values[k] : 0.0) + (k > 0 ? at * values[k - 1] : 0.0);
  return values;
}

}  // namespace batten
