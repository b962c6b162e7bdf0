// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/plane.h"

namespace batten {

struct EdgePoint {
  int x, y;        ///< On the plane's grid.
  float strength;  ///< [grey / grid step] Length of the gradient beyond the region's own slope.
};

struct InkEdges {
  BitImage area;                  ///< Everything steep, in pieces that hold something certain.
  std::vector<EdgePoint> crests;  ///< Where the gradient is largest across the edge, in reading order.
};

/// Finds the edges that stand out of the page's own noise and slope, both measured in each of the 64 regions.
InkEdges findInkEdges(const Plane& smoothed, const RunContext& context);

}  // namespace batten
