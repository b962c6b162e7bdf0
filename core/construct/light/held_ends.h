// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/construct/light/light_fit.h"
#include "core/construct/light/light_reference.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// The curve with the held tangents and curvatures of the reference exactly at its ends: the second control point moves
/// onto the tangent, the third across it. Meant for a curve that nearly has them (LightFit::reached). Absent where it
/// has too few control points for that. @pre clamped, open, not rational.
std::optional<NurbsCurve> withHeldEnds(const NurbsCurve&, const LightReference&, LightHold start, LightHold end);

/// Whether the ends of a curve are those of the reference as held, to a ten-thousandth of a radian and a hundredth of
/// the reference's largest curvature.
bool endsAreHeld(const NurbsCurve&, const LightReference&, LightHold start, LightHold end);

}  // namespace batten
