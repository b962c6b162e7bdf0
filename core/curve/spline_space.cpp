// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/spline_space.h"

#include <utility>

namespace batten {

std::vector<Vec2> SplineSpace::unrolled(const std::vector<Vec2>& controlPoints) const {
  std::vector<Vec2> all;
  all.reserve(count);
  for (int i = 0; i < count; ++i) all.push_back(controlPoints[i % unknowns]);
  return all;
}

SplineSpace splineSpace(int degree, std::vector<double> places, bool closed) {
  SplineSpace space;
  space.degree = degree;
  space.closed = closed;
  const auto last = places.size() - 1;
  const double period = places[last] - places[0];
  for (int k = degree; k >= 1; --k) {
    const std::size_t back = k;
    space.knots.push_back(closed ? places[last - back] - period : places[0] - k * (places[1] - places[0]));
  }
  space.knots.insert(space.knots.end(), places.begin(), places.end());
  for (int k = 1; k <= degree; ++k) {
    space.knots.push_back(closed ? places[k] + period : places[last] + k * (places[last] - places[last - 1]));
  }
  space.count = static_cast<int>(space.knots.size()) - degree - 1;
  space.unknowns = closed ? static_cast<int>(last) : space.count;
  space.places = std::move(places);
  return space;
}

std::vector<double> uniformPlaces(std::size_t points, bool closed) {
  std::vector<double> places;
  for (std::size_t i = 0; i < points + (closed ? 1 : 0); ++i) places.push_back(static_cast<double>(i));
  return places;
}

}  // namespace batten
