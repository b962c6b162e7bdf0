// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/curve/nurbs_curve.h"

namespace batten {

/// Largest difference between the curvatures of both sides of a joint (a knot inside the curve; closed: the seam too),
/// relative to the largest curvature at the joints and ends. 0 for a curve with one curvature at every joint (G2), up
/// to rounding; a joint at which a derivative vanishes does not count. @pre no corner inside the curve.
double largestCurvatureJump(const NurbsCurve&, bool closed);

}  // namespace batten
