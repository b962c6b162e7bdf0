// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/cancel_check.h"

namespace batten {

/// A place and the value of a function there.
struct ValueAt {
  double at = 0.0, value = 0.0;
};

/// Where a function of one variable is least, by golden section (Kiefer 1953). Of several minima it finds one; of a
/// function that has no minimum inside it comes close to the end where it is least.
/// @param steps each leaves 0.618 of the stretch: 20 leave 1/15000.
/// @pre low <= high. A cancelled search gives the best place so far.
template <typename Function>
ValueAt goldenSection(const Function& function, double low, double high, int steps, CancelCheck check = {}) {
  constexpr double kPart = 0.6180339887498949;  // of a stretch is left by a step: (sqrt(5) - 1) / 2
  const auto valueAt = [&](double at) { return ValueAt{at, function(at)}; };
  ValueAt left = valueAt(high - kPart * (high - low)), right = valueAt(low + kPart * (high - low));
  for (int step = 0; step < steps && !check.isCancelled(); ++step) {
    if (left.value < right.value) {
      high = right.at;
      right = left;
      left = valueAt(high - kPart * (high - low));
    } else {
      low = left.at;
      left = right;
      right = valueAt(low + kPart * (high - low));
    }
  }
  return left.value < right.value ? left : right;
}

}  // namespace batten
