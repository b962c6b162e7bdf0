// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"
#include "core/image/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// Ink to ordered lines: borders by crack following, strokes by their skeleton, each refined on the raw grey values.
/// The mask decides topology only; positions come from `grey` where EdgeParams::subpixel is on.
/// @return NoCurve, with what to do, if nothing long enough is left.
Result<ContourSet> traceContours(const BitImage& ink, const GreyImage& grey, const EdgeParams&, const ContourParams&,
                                 const RunContext&);

}  // namespace batten
