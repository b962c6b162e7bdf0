// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"
#include "core/image/bits/bit_image.h"

/// Ink of which too little was traced: how much lines leave, and nets that were lost.
namespace batten {

/// Whether lines can be held against the ink: of merged and intended lines one stands for several strokes, and what the
/// user wants of the ink holds.
bool isOfAllInk(const EdgeParams&, const ContourParams&);

/// The borders of a net of lines wider than the paper between them, where the lines found may have lost one and the
/// borders show more of it; else absent.
Result<std::optional<ContourSet>> bordersOfLostNet(const ContourSet& lines, const BitImage& ink, const EdgeParams&,
                                                   const ContourParams&, const RunContext&);

/// Says so where most of the ink is not traced. Margins have a note of their own.
void noteUntraced(ContourSet&, const BitImage& ink);

}  // namespace batten
