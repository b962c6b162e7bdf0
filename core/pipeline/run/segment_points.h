// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/typical/typical_growing.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// The segment points of every piece: each belongs to the nearest piece within the corner reach. Indices into
/// recipe.segmentPoints, one list per piece.
std::vector<std::vector<std::size_t>> assignSegmentPoints(const PieceSet&, const Recipe&);

/// How the typical chain of one curve grows (002 section 6), step by step, in model mm. Works whatever the method of
/// the recipe is. Empty for lines that nowhere bend clearly. @return Numerical while there is no such piece.
Result<std::vector<GrowingStep>> growingStepsOf(const PieceSet&, const SegmentSet&, const Recipe&, const PageFrame&,
                                                int piece, const RunContext&);

}  // namespace batten
