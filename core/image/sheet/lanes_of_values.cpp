// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/lanes_of_values.h"

#include <limits>

#include "core/base/hot_loop.h"

namespace batten {
namespace {

/// Puts the lesser of two values before the greater, in every lane.
BATTEN_HOT_LOOP void orderLanes(std::int16_t* __restrict low, std::int16_t* __restrict high, int lanes) {
  for (int i = 0; i < lanes; ++i) {
    const std::int16_t a = low[i], b = high[i];
    low[i] = a < b ? a : b;
    high[i] = a < b ? b : a;
  }
}

BATTEN_HOT_LOOP void lessOf(const std::int16_t* __restrict values, std::int16_t* __restrict least, int lanes) {
  for (int i = 0; i < lanes; ++i) least[i] = values[i] < least[i] ? values[i] : least[i];
}

}  // namespace

std::int16_t* LanesOfValues::add() {
  values_.resize(values_.size() + lanes_);
  return &*(values_.end() - lanes_);
}

std::vector<std::int16_t> LanesOfValues::leastOf() const {
  std::vector<std::int16_t> least(lanes_, std::numeric_limits<std::int16_t>::max());
  for (int k = 0; k < count(); ++k) lessOf(values_.data() + std::ptrdiff_t{k} * lanes_, least.data(), lanes_);
  return least;
}

void LanesOfValues::sortTo(int rank) {
  const auto place = [&](int k) { return values_.data() + std::ptrdiff_t{k} * lanes_; };
  // Each round carries the greatest of those that are left behind the others.
  for (int end = count() - 1; end >= rank; --end) {
    for (int k = 0; k < end; ++k) orderLanes(place(k), place(k + 1), lanes_);
  }
}

}  // namespace batten
