// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

class SkeletonGraph;

/// Makes one node of junctions that are nearer than their discs allow to tell apart (a crossing at a shallow angle).
/// `ofBundles`: all the crossings of overdrawn strokes with others too.
void mergeJunctions(SkeletonGraph& graph, bool ofBundles);

}  // namespace batten
