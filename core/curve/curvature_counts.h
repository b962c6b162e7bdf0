// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/curve/nurbs_curve.h"

namespace batten {

struct CurvatureCounts {
  int extrema = 0, inflections = 0;
};

/// How many there are of curvatureExtrema and of inflections, with the prominence as their threshold: from one look at
/// the curve, and without the places, which cost more than the counts.
CurvatureCounts curvatureCounts(const NurbsCurve&, double prominence, bool periodic);

}  // namespace batten
