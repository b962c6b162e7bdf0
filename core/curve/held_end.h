// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// The curve with a given direction, and a given curvature, at one end: the second control point moves onto the
/// tangent, the third across it. Meant for a curve that nearly has them. Absent where it has too few control points for
/// both ends to be held so. @param tangent of length 1, the way the curve runs. @param kappa [1/mm] positive to the
/// left; absent: free. @pre clamped, open, not rational.
std::optional<NurbsCurve> withEnd(const NurbsCurve&, bool atEnd, const Vec2& tangent, std::optional<double> kappa);

}  // namespace batten
