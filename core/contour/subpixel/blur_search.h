// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/contour/subpixel/pixel_edge.h"

namespace batten {

/// Index of the table of PixelResponse for about this blur [px].
inline int blurIndex(double blur) {
  return std::clamp(static_cast<int>(std::lround(blur / PixelResponse::kStepPx)) - 1, 0, PixelResponse::kBlurs - 1);
}

/// Index of the blur that leaves least of the pixels' grey unexplained: from `start` downhill, in each of the strides
/// in turn, since what is left has one minimum. @param left of an index: a number that grows with what is unexplained.
template <typename Left>
int leastBlur(int start, std::span<const int> strides, const Left& left) {
  int best = start;
  double least = left(best);
  for (const int stride : strides) {
    for (const int step : {-stride, stride}) {
      for (int next = best + step; next >= 0 && next < PixelResponse::kBlurs; next += step) {
        const double sum = left(next);
        if (!(sum < least)) break;
        least = sum;
        best = next;
      }
    }
  }
  return best;
}

}  // namespace batten
