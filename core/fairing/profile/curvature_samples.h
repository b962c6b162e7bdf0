// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/curve/nurbs_curve.h"

namespace batten {

/// Curvature at equal arc length, both ends included.
struct CurvatureSamples {
  std::vector<double> perimeter;  ///< 0..1.
  std::vector<double> kappa;      ///< [1/mm]
  double lengthMm = 0.0;          ///< 0: the curve has none, and all curvatures are 0.
};

/// @param least at least so many samples; at least four a knot span are taken.
CurvatureSamples sampledCurvature(const NurbsCurve&, int least);

}  // namespace batten
