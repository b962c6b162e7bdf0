// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Position with first and second derivative where a corner fill begins or ends.
using CurveEnd = std::array<Vec2, 3>;
CurveEnd startOf(const NurbsCurve&);
CurveEnd endOf(const NurbsCurve&);

/// A quintic that follows points closely round a sharp turn: least squares on knots of 3 px and more with a penalty
/// that holds back only the noise of single points. Meets `before` and `after` with two derivatives. All in px.
/// @return Numerical when there is no length to follow.
Result<NurbsCurve> cornerFill(std::span<const Vec2> points, const std::optional<CurveEnd>& before,
                              const std::optional<CurveEnd>& after);
/// The same all round a closed line: periodic, all derivatives meet.
Result<NurbsCurve> tightLoop(std::span<const Vec2> points);

/// Joins quintics end to start that agree in position and two derivatives, with knots of multiplicity 3.
Result<NurbsCurve> joinSmoothly(std::span<const NurbsCurve> parts);

}  // namespace batten
