// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace batten::test {

/// Clamped knots for `count` control points, spans of length 1 from 0 on.
inline std::vector<double> clampedUnitKnots(int degree, int count) {
  const int spans = count - degree;
  std::vector<double> knots(degree + 1, 0.0);
  for (int i = 1; i < spans; ++i) knots.push_back(i);
  knots.insert(knots.end(), degree + 1, spans);
  return knots;
}

}  // namespace batten::test
