// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "core/curve/nurbs_curve.h"

namespace batten {

/// A curve in numbers, for who wants to compute with it: knot vector and control points; every polynomial piece by its
/// coefficients in ascending powers of t in 0..1 from `start` to `end` of the parameter (absent for rational curves);
/// and series at equal arc length: parameter, arc length, radius (null where straight), curvature, its slope and the
/// length of the first derivative. Model frame, mm.
nlohmann::ordered_json curveSeriesToJson(const NurbsCurve&);

}  // namespace batten
