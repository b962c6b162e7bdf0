// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <ctime>
#include <limits>

namespace batten::test {

/// The processor time of this program while `work` runs, seconds.
template <class Work>
double secondsOf(const Work& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// Whether `large` costs at most `limit` times what `small` does; each returns the seconds it took. Both run by turns
/// until the least times of each say so: what else a machine does only ever adds to a time, so that work which grows as
/// it should passes sooner or later, and work which grows faster never does.
template <class Small, class Large>
bool growsAtMost(double limit, const Small& small, const Large& large) {
  constexpr int kMostTurns = 20;
  double leastOfSmall = std::numeric_limits<double>::infinity(), leastOfLarge = leastOfSmall;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    leastOfSmall = std::min(leastOfSmall, small());
    leastOfLarge = std::min(leastOfLarge, large());
    if (turn > 0 && leastOfLarge < limit * leastOfSmall) return true;
  }
  return false;
}

}  // namespace batten::test
