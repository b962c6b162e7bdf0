// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/junction/merged_junctions.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Strokes and the junctions where they meet.
struct StrokePathSet {
  std::vector<StrokePath> paths;
  std::vector<StrokeJunction> junctions;
};

/// The strokes of a skeleton: spurs pruned, junctions of one crossing merged, smooth edges led through (see
/// EdgeParams). Deterministic order. Empty when cancelled.
/// @param of Pencil: the ink is what strokes of a pencil became, with the grain closed. Where strokes are merged all
/// are of bundles, whatever is given.
StrokePathSet findPathsAndJunctions(const BitImage& skeleton, const BitImage& ink, const EdgeParams& params,
                                    const RunContext& context, JunctionsOf of = JunctionsOf::Pen);
/// Its paths alone.
std::vector<StrokePath> findStrokePaths(const BitImage& skeleton, const BitImage& ink, const EdgeParams& params,
                                        const RunContext& context);

}  // namespace batten
