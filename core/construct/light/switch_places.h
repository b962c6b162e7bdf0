// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace batten {

/// Places along a curve where the slope of the curvature may change its sign, chosen so that what has the wrong sign
/// costs least: dynamic programming over the samples, O(samples x changes). Keeps its memory from call to call.
class SwitchPlaces {
 public:
  enum class Changes {
    Exactly,  ///< All of them, each run of at least one sample.
    AtMost,   ///< Or fewer, from either end; around a closed curve two at a time and none at the seam.
  };
  /// Signs per sample: `first` for a run of samples, then alternating, `changes` times.
  /// @param costIfRising what a sample costs where the curvature should fall; costIfFalling where it should rise.
  /// @pre both of one size, more samples than changes.
  const std::vector<signed char>& choose(const std::vector<double>& costIfRising,
                                         const std::vector<double>& costIfFalling, int first, int changes,
                                         Changes kind = Changes::Exactly, bool closed = false);

 private:
  std::vector<signed char> signs_;
  std::vector<double> best_, next_;  ///< Per run, after one that costs without end.
  std::vector<std::uint8_t> came_;   ///< Per sample and run: 1 = the run began there.
};

}  // namespace batten
