// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

namespace batten {

/// A value of a sequence from which it turns back.
struct ExtremumIndex {
  int index = 0;
  bool maximum = true;
};

/// Where the walk along a sequence begins.
enum class SequenceStart {
  AtEnd,      ///< The first value is an end, and no extremum.
  OnMaximum,  ///< The first value is the greatest of a closed sequence, which repeats it at the end.
};

/// Maxima and minima in turn, in order: those from which the sequence comes back by more than `prominence` before it
/// goes beyond them (hysteresis). The last value is none.
std::vector<ExtremumIndex> extremumIndices(std::span<const double> values, double prominence, SequenceStart start);

/// Number of extrema that a sequence comes back from by more than `prominence`. Closed: the last value is followed by
/// the first.
int countExtrema(std::span<const double> values, double prominence, bool closed);

}  // namespace batten
