// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/exchange/model/cad_shape.h"
#include "core/exchange/model/drawing_figures.h"

namespace batten {

/// A drawing as STEP AP214: a geometric curve set, one B_SPLINE_CURVE_WITH_KNOTS, trimmed LINE or (trimmed) CIRCLE per
/// entity, no curve flagged closed, 17 digits, with the figures as geometric validation properties (CAx-IF Recommended
/// Practices): independent curve length and centroid, smooth sampling points. Names as strings of ISO 10303-21.
Result<std::string> writeStep(const CadDrawing&, const DrawingFigures&, const std::string& title);

}  // namespace batten
