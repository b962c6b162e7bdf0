// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/curve/nurbs_curve.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// Curvature at equal arc length, both ends included.
struct CurvatureSamples {
  std::vector<double> kappa;  ///< [1/mm]
  double lengthMm = 0.0;      ///< 0: the curve has none, and all curvatures are 0.

  int count() const { return static_cast<int>(kappa.size()); }
  /// 0..1, share of the arc length at which a sample lies.
  double perimeter(int sample) const { return static_cast<double>(sample) / (count() - 1); }
  std::vector<double> perimeters() const;
  std::vector<CurvatureSample> places() const;  ///< With the place of each.
};

/// @param least at least so many samples; at least four a knot span are taken.
CurvatureSamples sampledCurvature(const NurbsCurve&, int least);

}  // namespace batten
