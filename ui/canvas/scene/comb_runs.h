// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "ui/canvas/scene/curve_shapes.h"

namespace batten {

/// Height [image px] per curvature [1/mm], or per radius [mm], and the height at which quills are cut.
struct CombScale {
  double pxPerKappa = 0.0, limitPx = 0.0;
  double pxPerRadius = 0.0;  ///< Above 0: quills show the radius, which has no end where the curve is straight.
  bool isEmpty() const { return !(pxPerKappa > 0.0) && !(pxPerRadius > 0.0); }
  double limitKappa() const;            ///< [1/mm] at which quills are cut.
  double heightOf(double kappa) const;  ///< [image px], signed, cut.
  bool cuts(double kappa) const;
};

/// Neighbouring points of a comb that are all drawn in full, or all cut.
struct CombRun {
  std::size_t first = 0, last = 0;  ///< Both belong to the run.
  std::size_t peak = 0;             ///< Where the curvature is largest.
  bool isCut = false;
  /// A few quills only: one of them, cut, says more than the bundle.
  bool isSpike = false;
};
/// All runs in order; they cover the points without gaps.
std::vector<CombRun> combRuns(const std::vector<CombPoint>&, const CombScale&);
/// The place between two neighbours at which the curvature just reaches the cut; the first one where none does.
CombPoint combCrossing(const CombPoint& uncut, const CombPoint& cut, const CombScale&);

/// A curve as a whole, as its comb needs it.
struct CombedCurve {
  double robustKappa = 0.0;  ///< [1/mm] 95 % of |kappa|.
  double extentPx = 0.0;     ///< [image px]
  double lengthPx = 0.0;     ///< [image px]
  int extrema = 0;           ///< Places where the curvature turns back.
};
/// The scale of quills that show radii: as high for the middle radius of a curve's points as those of its curvature
/// would be for its largest curvatures.
CombScale radiusScaleFor(const CombedCurve&, const std::vector<CombPoint>& points, double wantedScale, double viewPx);
/// The scale of combs for a curve, seen in a view `viewPx` [image px] high or wide (the smaller). The more the curve
/// turns to and fro, the lower they are: quills longer than a bend would hide it. No comb at all where the curve is
/// straight (`pxPerKappa` = 0).
CombScale combScaleFor(const CombedCurve&, double wantedScale, double viewPx);

}  // namespace batten
