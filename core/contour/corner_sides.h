// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/contour/contour_set.h"

namespace batten {

/// One side of a corner as a polynomial over a straight axis, ready to be extended to the corner and beyond.
struct CornerSide {
  static constexpr int kMostDegree = 4;
  Vec2 origin = Vec2::Zero();                         ///< [px] the contour point that the fit started from.
  Vec2 along = Vec2::Zero();                          ///< Unit axis, pointing away from the corner.
  Vec2 across = Vec2::Zero();                         ///< Unit, along turned by 90 degrees.
  std::array<double, kMostDegree + 1> coefficient{};  ///< [px] of powers of z, which is -1 at `from` and 1 at `to`.
  int degree = -1;                                    ///< -1: no fit.
  double from = 0.0;                                  ///< [px] the points used begin here...
  double to = 0.0;                                    ///< ...and end here, along the axis.
  double sigmaPx = 0.0;  ///< [px] standard deviation of the side where it is extended to x = 0.

  Vec2 at(double x) const;
  Vec2 derivative(double x) const;
};

/// Fits the side +1 (along the contour) or -1 (against it) of a point to the points `inner`..`outer` [px of arc] away.
/// Polynomials of order 1 to 4 over stretches of growing length extend it to the corner, each with a known variance,
/// which falls with the length and rises with the square of the order. The one with the least variance is taken among
/// those that neither the points nor the place of the extension contradict: up to three further orders explain no more
/// than noise and do not move the end by more than twice what noise would.
CornerSide fitCornerSide(const Contour& contour, int index, int side, double inner, double outer);

}  // namespace batten
