// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/plane.h"
#include "core/image/threshold/ink_edges.h"
#include "core/image/threshold/paper_fold.h"

namespace batten {

/// Nearly straight edges of one direction of contrast that run from border to border of the plane, best first: Hough
/// transform of the crests by their gradients, then a cubic through the crests of each line. Plane frame.
/// @param u the plane that the crests were found on.
std::vector<FoldCourse> findFoldLines(const Plane& u, const InkEdges& edges, const RunContext& context);

}  // namespace batten
