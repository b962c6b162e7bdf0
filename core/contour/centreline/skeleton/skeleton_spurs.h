// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

class SkeletonGraph;

/// Drops side branches that only a bump or a corner of the border caused. `factor` in stroke widths.
void pruneSpurs(SkeletonGraph& graph, double factor);

}  // namespace batten
