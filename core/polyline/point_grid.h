// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// Places on lines by square cells of the page, to be asked for what is near: all within the size of a cell are among
/// those around a point. In the order added within a cell; the order of cells is fixed.
template <class Place>
class PointGrid {
 public:
  explicit PointGrid(double sizePx) : size_(sizePx) {}
  void add(const Vec2& at, const Place& place) { cells_[key(cellOf(at.x()), cellOf(at.y()))].push_back(place); }
  template <class Visit>
  void around(const Vec2& at, const Visit& visit) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto found = cells_.find(key(cellOf(at.x()) + dx, cellOf(at.y()) + dy));
        if (found == cells_.end()) continue;
        for (const Place& place : found->second) visit(place);
      }
  }

 private:
  static constexpr double kFarthestCell = 1e9;  // cells beyond are one: their numbers and those beside them fit an int
  int cellOf(double v) const {
    return static_cast<int>(std::clamp(std::floor(v / size_), -kFarthestCell, kFarthestCell));
  }
  static std::int64_t key(int x, int y) { return (static_cast<std::int64_t>(y) << 32) ^ (x & 0xffffffffLL); }
  double size_;
  std::unordered_map<std::int64_t, std::vector<Place>> cells_;
};

}  // namespace batten
