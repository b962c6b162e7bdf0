// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/construct_params.h"
#include "core/construct/pieces.h"

namespace batten {

/// The contour as its true and fair fit shows it: points every pixel along the fit, and every station moved onto it,
/// in its direction: where its share of the length is known to that share, else to its foot point. Corners, constraints
/// and breakpoints stay. No knot removal: the fit is intermediate.
/// In px. @return what the fit says where it cannot be made.
Result<ConstructContour> onFairFit(const ConstructContour&, const ConstructParams&, const RunContext&);

}  // namespace batten
