// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/curve/nurbs_curve.h"

namespace batten {

/// How much the curvature changes along a curve: the integral of (d kappa / ds)^2 over the arc length times the third
/// power of the length, so that it does not depend on the size [-]. 0 for lines and circles; smaller is fairer (the
/// minimum variation curve of Moreton and Sequin). Corners inside the curve (multiple knots) do not count.
/// Gauss-Legendre per polynomial span; places where the first derivative vanishes are left out, so that the result is
/// always finite.
double variationEnergy(const NurbsCurve&);

}  // namespace batten
