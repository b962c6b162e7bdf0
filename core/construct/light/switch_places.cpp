// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/switch_places.h"

#include <limits>

namespace batten {

const std::vector<signed char>& SwitchPlaces::choose(const std::vector<double>& costIfRising,
                                                     const std::vector<double>& costIfFalling, int first, int changes,
                                                     Changes kind, bool closed) {
  const std::size_t n = costIfRising.size(), runs = static_cast<std::size_t>(changes) + 1;
  signs_.assign(n, static_cast<signed char>(first));
  if (changes == 0) return signs_;
  best_.assign(runs, std::numeric_limits<double>::infinity());
  came_.assign(runs * n, 0);
  const auto costs = [&](std::size_t run) -> const std::vector<double>& {
    const bool rises = (run % 2 == 0) == (first > 0);
    return rises ? costIfFalling : costIfRising;
  };
  const double infinite = std::numeric_limits<double>::infinity();
  const std::size_t lastStart = kind == Changes::AtMost && !closed ? 1 : 0;
  for (std::size_t j = 0; j < n; ++j) {
    // From the last run down: each takes the run before it as it was at the sample before.
    for (std::size_t run = runs; run-- > 0;) {
      const double begins = j == 0 ? (run <= lastStart ? 0.0 : infinite) : run == 0 ? infinite : best_[run - 1];
      const bool fresh = begins < best_[run];
      best_[run] = (fresh ? begins : best_[run]) + costs(run)[j];
      came_[run * n + j] = fresh ? 1 : 0;
    }
  }
  std::size_t run = runs - 1;
  if (kind == Changes::AtMost) {
    const std::size_t step = closed ? 2 : 1;
    for (std::size_t other = run; other >= step;) {
      other -= step;
      if (best_[other] <= best_[run]) run = other;
    }
  }
  for (std::size_t j = n; j-- > 0;) {
    signs_[j] = static_cast<signed char>(run % 2 == 0 ? first : -first);
    if (came_[run * n + j] != 0 && run > 0) --run;
  }
  return signs_;
}

}  // namespace batten
