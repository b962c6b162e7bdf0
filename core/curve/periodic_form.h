// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// A closed curve with every control point once: the knots run on over the seam, so that all derivatives up to degree -
/// 1 meet there whatever the control points are.
struct PeriodicForm {
  std::vector<double> knots;  ///< points.size() + 2 degree + 1 values; control point j is points[j modulo size].
  std::vector<Vec2> points;   ///< Control points.
};

/// Exact when the curve meets itself with all derivatives up to degree - 1; else its nearest periodic curve in the
/// least squares sense. @return Numerical when the curve has too few knots.
Result<PeriodicForm> toPeriodic(const NurbsCurve& curve);

/// The periodic curve over the knots of `like`, the curve that it was made from (exact, by blossoming).
Result<NurbsCurve> fromPeriodic(const PeriodicForm& form, const NurbsCurve& like);

}  // namespace batten
