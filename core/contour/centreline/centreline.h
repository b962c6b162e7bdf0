// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"
#include "core/image/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// Splits the ink into strokes and shapes: a component is a shape when more than half of its area survives an opening
/// by a disc of the stroke-width limit (EdgeParams::strokeWidth * sqrt(width * height)), unless EdgeParams::mode or the
/// user decides otherwise. Both masks have the size of `ink`.
struct StrokeSplit {
  BitImage strokes;
  BitImage shapes;
};
Result<StrokeSplit> splitStrokes(const BitImage& ink, const EdgeParams&, const RunContext&);

/// Centre lines of all strokes of a mask. The skeleton gives the topology: spurs are pruned, strokes continue through
/// crossings, gaps are bridged and, if asked, overdrawn strokes are merged. The grey profile across the stroke then
/// gives the positions.
Result<ContourSet> centrelines(const BitImage& strokes, const GreyImage& grey, const EdgeParams&, const RunContext&);

}  // namespace batten
