// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/turning_points.h"

namespace batten {

std::vector<TurningPoint> turningPoints(std::span<const double> values, double prominence, TurningStart start) {
  std::vector<TurningPoint> found;
  // Until the first move of that size there is no direction.
  enum class Direction { Unknown, Rising, Falling } direction = Direction::Unknown;
  int low = 0, high = 0;
  for (int i = 0; i < std::ssize(values); ++i) {
    if (values[i] > values[high]) high = i;
    if (values[i] < values[low]) low = i;
    if (direction != Direction::Falling && values[high] - values[i] > prominence) {
      if (direction == Direction::Rising || start == TurningStart::OnMaximum) found.push_back({high, true});
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

}  // namespace batten
