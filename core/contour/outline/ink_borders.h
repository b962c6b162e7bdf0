// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// The borders of ink that is followed along them, but the short ones.
/// @param penPx width of the pen [px]; absent: taken from the borders.
/// @param pencil what was drawn with one, whose grain leaves specks and holes; null: nothing is known.
Result<ContourSet> bordersOf(const BitImage& ink, bool holes, const ContourParams& params, std::optional<double> penPx,
                             const BitImage* pencil, const RunContext& context);

/// Notes on the borders of what a pencil filled how wide that is: they have grain. @param pencilPx width [px]
void notePencil(ContourSet& borders, const BitImage& pencil, double pencilPx);

}  // namespace batten
