// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/contour_set.h"

#include <algorithm>
#include <cstdlib>

namespace batten {

std::vector<Vec2> inkBeside(const Contour& c, std::size_t point) {
  if (c.band.left.size() != c.chain.size() || c.chain.size() < 2) return {c.chain[point]};
  const std::size_t before = point > 0 ? point - 1 : 0, after = std::min(point + 1, c.chain.size() - 1);
  const Vec2 along = c.chain[after] - c.chain[before];
  if (!(along.norm() > 0.0)) return {c.chain[point]};
  const Vec2 left = leftNormal(along.normalized());
  return {c.chain[point], c.chain[point] + static_cast<double>(c.band.left[point]) * left,
          c.chain[point] - static_cast<double>(c.band.right[point]) * left};
}

Vec2 placeOnInk(const Contour& c) {
  const int n = static_cast<int>(c.chain.size()), middle = n / 2;
  const auto isBridge = [&](int i) {
    return std::any_of(c.bridges.begin(), c.bridges.end(),
                       [i](const auto& range) { return range.first <= i && i <= range.second; });
  };
  int best = middle;
  for (int i = 0, least = n + 1; i < n; ++i) {
    if (std::abs(i - middle) >= least || isBridge(i)) continue;
    least = std::abs(i - middle);
    best = i;
  }
  const auto at = static_cast<std::size_t>(best);
  const std::vector<Vec2> places = inkBeside(c, at);
  if (places.size() == 1) return places[0];
  return c.band.left[at] >= c.band.right[at] ? places[1] : places[2];
}

int bridgeCount(const ContourSet& set) {
  std::size_t count = 0;
  for (const Contour& contour : set.contours) count += contour.bridges.size();
  return static_cast<int>(count);
}

}  // namespace batten
