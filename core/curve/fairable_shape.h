// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/curve/nurbs_curve.h"

namespace batten {

/// What fairing starts from where a curve has too little freedom of its own: the same shape with degree 5 or more and
/// no span longer than a sixteenth of its length. Absent where it has enough; also for rational curves, which cannot be
/// raised exactly.
std::optional<NurbsCurve> fairableShape(const NurbsCurve&);

/// A quintic with simple knots (C4) that lies within `tolerance` of a curve without corners, by least squares at equal
/// arc length; open curves keep the place, direction and curvature of their ends exactly. For curves of pieces that
/// meet with one tangent or curvature only: moved freely, their control points would part them there. Also for arcs.
/// None where no 256 spans are enough, and for curves without length.
std::optional<NurbsCurve> smoothShape(const NurbsCurve&, bool closed, double tolerance);

}  // namespace batten
