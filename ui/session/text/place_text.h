// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <optional>

#include "core/curve/nurbs_curve.h"

namespace batten {

/// [1/mm] The curvature at a length along the curve, exactly; none where the curve has none.
std::optional<double> curvatureAtLength(const NurbsCurve&, double sMm);

/// The radius at a place of a curve as canvas and plot both say it: "R 45.4 mm", or "straight".
QString radiusText(double kappa, const NurbsCurve& of);

}  // namespace batten
