// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/plane.h"
#include "core/image/threshold/ink_edges.h"
#include "core/image/threshold/paper_fold.h"

namespace batten {

/// Folds and edges of shadows that run across the page: nearly straight lines from border to border along which the
/// grey steps to another level of paper and stays there. A drawn line is none, since the paper returns to its level
/// behind it; nor is a broad bar, or the side of something much darker than shaded paper.
/// @param smoothed, edges of the picture shrunk by `shrink`.
std::vector<PaperFold> findFolds(const GreyImage& image, const Plane& smoothed, const InkEdges& edges, int shrink,
                                 const RunContext& context);

}  // namespace batten
