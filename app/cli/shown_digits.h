// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace batten::cli {

/// The number with so many decimals, for result lines: JSON writes the shortest text of a number, and
/// 578.4834909999 ms says no more than 578.5. NaN and infinity stay what they are.
inline double withDecimals(double value, int decimals) {
  const double factor = std::pow(10.0, decimals);
  return std::round(value * factor) / factor;
}

}  // namespace batten::cli
