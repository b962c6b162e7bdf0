// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/construct/light/light_reference.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// The exact shapes that a designer would have drawn instead of a spline. Ends lie on the ends of the reference; the
/// domain is [0, length].

/// The chord, degree 1 with 2 control points, when no sample lies farther than half the tolerance from it.
std::optional<NurbsCurve> exactLine(const LightReference&, double tolerance);

/// The arc through both ends (closed: the circle) as a rational quadratic: 3 control points up to 120 degrees, two more
/// for every further 120. When no sample lies farther than half the tolerance from it.
std::optional<NurbsCurve> exactArc(const LightReference&, double tolerance);

}  // namespace batten
