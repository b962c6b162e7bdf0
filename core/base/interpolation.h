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

}  // namespace batten
