// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// The same closed curve, begun at u instead: exact, clamped, over a domain of the same length. The knot at the old
/// seam stays as often as the curve needs it: once where all derivatives up to degree - 1 meet there. Rational curves
/// keep it `degree` times. A curve that already begins at u, within 1e-9 of its domain, is returned unchanged.
/// @pre the ends of the curve meet.
Result<NurbsCurve> startedAt(const NurbsCurve& closed, double u);

/// The same closed curve, begun at its point nearest to a place; unchanged if that is impossible.
NurbsCurve startedNear(const NurbsCurve& closed, const Vec2& place);

}  // namespace batten
