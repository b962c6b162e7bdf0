// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "core/contour/contour_set.h"

namespace batten {

/// One side of a corner as a polynomial over a straight axis, to be extended to the corner and beyond. Beyond `from`,
/// away from the corner, it need not follow the points.
struct CornerSide {
  static constexpr int kMostDegree = 3;               ///< What a value and three derivatives give.
  Vec2 origin = Vec2::Zero();                         ///< [px] the contour point that the fit started from.
  Vec2 along = Vec2::Zero();                          ///< Unit axis, pointing away from the corner.
  Vec2 across = Vec2::Zero();                         ///< Unit, along rotated by 90 degrees.
  std::array<double, kMostDegree + 1> coefficient{};  ///< [px] of powers of z, which is -1 at `from` and 1 at `to`.
  double from = 0.0;                                  ///< [px] the points used begin here...
  double to = 0.0;                                    ///< ...and end here, along the axis.
  /// Covariance of the side and its derivatives 1 to 3 with respect to x at `from` [px, 1/px per derivative].
  std::array<double, 16> spread{};
  double sigmaPx = 0.0;  ///< [px] standard deviation of the side where it is extended to x = 0.

  Vec2 at(double x) const;
  Vec2 derivative(double x) const;
};

struct CornerSides {
  CornerSide before, after;  ///< Against and along the contour.
};

/// Fits the side +1 (along the contour) or -1 (against it) of a point to the points `inner`..`outer` [px of arc] away
/// and extends it to the corner. The candidates are a line, an arc, and curves whose fourth derivative is white noise
/// of some density (a spline, as in the fair fit), each over stretches of several lengths from the corner on. The
/// result is their mean, weighted by marginal likelihood (Kalman filter towards the corner). `sigmaPx` includes the
/// uncertainty of the choice. Nothing where there are too few points.
std::optional<CornerSide> fitCornerSide(const Contour& contour, int index, int side, double inner, double outer);

}  // namespace batten
