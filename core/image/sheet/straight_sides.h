// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

inline constexpr int kMostSides = 4;
/// A straight side of an area of cells.
struct StraightSide {
  Vec2 inward{0.0, 0.0};  ///< A unit vector.
  double offset = 0.0;    ///< [cells]
  int count = 0;          ///< [cells] Of the outline on it.
  /// [cells] Positive on the side of the area.
  double depth(const Vec2& cell) const { return inward.dot(cell) - offset; }
};

/// Up to four lines with the most of the outline of an area on them and hardly any of the area beyond; what of the
/// outline lies at the border of the picture is no side.
/// @param area a mask of the cells, not 0 inside.
std::vector<StraightSide> straightSides(const cv::Mat1b& area);

}  // namespace batten
