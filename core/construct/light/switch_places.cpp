// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/switch_places.h"

#include <limits>

namespace batten {

const std::vector<signed char>& SwitchPlaces::choose(const std::vector<double>& costIfRising,
                                                     const std::vector<double>& costIfFalling, int first, int changes,
                                                     Changes kind, bool closed) {
  const std::size_t n = costIfRising.size(), runs = changes + 1;
  signs_.assign(n, static_cast<signed char>(first));
  if (changes == 0) return signs_;
  const double infinite = std::numeric_limits<double>::infinity();
  best_.assign(runs + 1, infinite);
  next_.assign(runs + 1, infinite);
  came_.resize(runs * n);
  const double* costs[2] = {first > 0 ? costIfFalling.data() : costIfRising.data(),
                            first > 0 ? costIfRising.data() : costIfFalling.data()};
  // Run r stands at r + 1; before the first sample only those are begun that may be the first one.
  const std::size_t lastStart = kind == Changes::AtMost && !closed ? 1 : 0;
  for (std::size_t run = 0; run <= lastStart; ++run) {
    best_[run + 1] = costs[run % 2][0];
    came_[run] = 1;
  }
  for (std::size_t run = lastStart + 1; run < runs; ++run) came_[run] = 0;
  for (std::size_t j = 1; j < n; ++j) {
    const double own[2] = {costs[0][j], costs[1][j]};
    const double* best = best_.data();
    double* next = next_.data();
    std::uint8_t* came = came_.data() + j * runs;
    for (std::size_t run = 0; run < runs; ++run) {
      const double begins = best[run], continues = best[run + 1];
      next[run + 1] = (begins < continues ? begins : continues) + own[run % 2];
      came[run] = begins < continues ? 1 : 0;
    }
    best_.swap(next_);
  }
  std::size_t run = runs - 1;
  if (kind == Changes::AtMost) {
    const std::size_t step = closed ? 2 : 1;
    for (std::size_t other = run; other >= step;) {
      other -= step;
      if (best_[other + 1] <= best_[run + 1]) run = other;
    }
  }
  for (std::size_t j = n; j-- > 0;) {
    signs_[j] = static_cast<signed char>(run % 2 == 0 ? first : -first);
    if (came_[j * runs + run] != 0 && run > 0) --run;
  }
  return signs_;
}

}  // namespace batten
