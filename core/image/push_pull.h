// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace batten {

/// Fills a grid from its weighted cells: means over ever larger blocks (push), then every cell is mixed with the
/// smoothly enlarged coarser grid by what its weight lacks of 1 (pull). A cell of weight 1 keeps its value; without any
/// weight all becomes 0.
/// @param weights 0..1 for every cell, as many as values: columns * rows.
std::vector<float> pushPull(const std::vector<float>& values, const std::vector<float>& weights, int columns, int rows);

}  // namespace batten
