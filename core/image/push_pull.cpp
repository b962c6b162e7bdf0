// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/push_pull.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace batten {
namespace {

struct Level {
  int columns, rows;
  std::vector<float> value, weight;
  std::size_t at(int x, int y) const { return std::ptrdiff_t{y} * columns + x; }
};

Level coarser(const Level& fine) {
  Level coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}, {}};
  const std::size_t count = std::ptrdiff_t{coarse.columns} * coarse.rows;
  coarse.value.assign(count, 0.0f);
  coarse.weight.assign(count, 0.0f);
  for (int y = 0; y < coarse.rows; ++y) {
    for (int x = 0; x < coarse.columns; ++x) {
      float sum = 0.0f, weight = 0.0f;
      for (int j = 2 * y; j < std::min(2 * y + 2, fine.rows); ++j) {
        for (int i = 2 * x; i < std::min(2 * x + 2, fine.columns); ++i) {
          sum += fine.weight[fine.at(i, j)] * fine.value[fine.at(i, j)];
          weight += fine.weight[fine.at(i, j)];
        }
      }
      coarse.value[coarse.at(x, y)] = weight > 0.0f ? sum / weight : 0.0f;
      coarse.weight[coarse.at(x, y)] = std::min(1.0f, weight);
    }
  }
  return coarse;
}

/// Two neighbouring coarse cells and the share of the second, for a fine cell: weights 3/4 and 1/4.
std::pair<int, int> coarsePair(int fine, int coarseCount) {
  const int near = fine / 2;
  const int other = std::clamp((fine & 1) != 0 ? near + 1 : near - 1, 0, coarseCount - 1);
  return {near, other};
}

void pull(Level& fine, const Level& coarse) {
  for (int y = 0; y < fine.rows; ++y) {
    const auto [y0, y1] = coarsePair(y, coarse.rows);
    for (int x = 0; x < fine.columns; ++x) {
      const float weight = fine.weight[fine.at(x, y)];
      if (weight >= 1.0f) continue;
      const auto [x0, x1] = coarsePair(x, coarse.columns);
      const float above = 0.75f * coarse.value[coarse.at(x0, y0)] + 0.25f * coarse.value[coarse.at(x1, y0)];
      const float below = 0.75f * coarse.value[coarse.at(x0, y1)] + 0.25f * coarse.value[coarse.at(x1, y1)];
      float& value = fine.value[fine.at(x, y)];
      value = weight * value + (1.0f - weight) * (0.75f * above + 0.25f * below);
    }
  }
}

}  // namespace

std::vector<float> pushPull(const std::vector<float>& values, const std::vector<float>& weights, int columns,
                            int rows) {
  if (columns <= 0 || rows <= 0) return {};
  std::vector<Level> levels;
  levels.push_back({columns, rows, values, weights});
  while (levels.back().columns > 1 || levels.back().rows > 1) levels.push_back(coarser(levels.back()));
  for (std::size_t i = levels.size() - 1; i-- > 0;) pull(levels[i], levels[i + 1]);
  return std::move(levels.front().value);
}

}  // namespace batten
