// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/curve/nurbs_curve.h"

namespace batten {

/// How fair a curve is, in three figures.
struct CurveFairness {
  /// [-] 0..1. S (003 Eq 14) of the curve and of the nearest one whose curvature only rises or only falls; of a closed
  /// curve, whose curvature cannot, does so between four extrema. 1: it is such a curve itself. Of the radii; where the
  /// curve bends both ways or has straight parts, and its radius no end, of the curvatures.
  double similarity = 0.0;
  /// [-] -1..1. The same to the nearest log-aesthetic curve, which is one of those, and so no nearer; absent where
  /// `similarity` is below 0.9.
  std::optional<double> logAesthetic;
  std::optional<double> alpha;  ///< Of that one; absent where it is a straight line or circle, or is in several spans.
  int extrema = 0;              ///< Of its curvature, of the usual prominence.
  int controlPoints = 0;
};

/// A curve with sharp corners inside has the mean of its parts, by their lengths. @return none for a curve without
/// length.
std::optional<CurveFairness> curveFairness(const NurbsCurve&, bool closed);

/// The nearest values, by least squares, that never fall. Pool adjacent violators: Ayer et al., Ann. Math. Statist. 26
/// (1955).
std::vector<double> nearestRising(const std::vector<double>& values);

}  // namespace batten
