// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/extremum_indices.h"

#include <algorithm>

namespace batten {

std::vector<ExtremumIndex> extremumIndices(std::span<const double> values, double prominence, SequenceStart start) {
  std::vector<ExtremumIndex> found;
  // Until the first move of that size there is no direction.
  enum class Direction { Unknown, Rising, Falling } direction = Direction::Unknown;
  int low = 0, high = 0;
  for (int i = 0; i < std::ssize(values); ++i) {
    if (values[i] > values[high]) high = i;
    if (values[i] < values[low]) low = i;
    if (direction != Direction::Falling && values[high] - values[i] > prominence) {
      if (direction == Direction::Rising || start == SequenceStart::OnMaximum) found.push_back({high, true});
      direction = Direction::Falling;
      low = i;
    } else if (direction != Direction::Rising && values[i] - values[low] > prominence) {
      if (direction == Direction::Falling) found.push_back({low, false});
      direction = Direction::Rising;
      high = i;
    }
  }
  return found;
}

int countExtrema(std::span<const double> values, double prominence, bool closed) {
  if (values.empty()) return 0;
  if (!closed) return static_cast<int>(extremumIndices(values, prominence, SequenceStart::AtEnd).size());
  std::vector<double> around(values.begin(), values.end());
  std::rotate(around.begin(), std::max_element(around.begin(), around.end()), around.end());
  around.push_back(around.front());
  return static_cast<int>(extremumIndices(around, prominence, SequenceStart::OnMaximum).size());
}

}  // namespace batten
