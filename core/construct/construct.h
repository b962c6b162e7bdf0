// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/construct_params.h"
#include "core/construct/pieces.h"

namespace batten {

/// Constructs all pieces of a contour, in order. Where a corner bounds a piece the curve ends exactly there (but for
/// SharpKnots::Order, which breaks it). A closed
/// smooth piece gives a curve whose ends meet with all derivatives (Fair, Nurbs, ControlPolygon), with two (Bezier), or
/// with place, direction and curvature (Typical).
/// @return Numerical, with what to do, if a piece holds too little to construct anything.
Result<std::vector<ConstructedPiece>> construct(const ConstructContour&, const ConstructParams&, const RunContext&);

}  // namespace batten
