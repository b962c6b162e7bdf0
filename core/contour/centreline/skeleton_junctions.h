// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/contour/edge_params.h"

namespace batten {

class SkeletonGraph;

/// Makes one node of junctions that are nearer than their discs allow to tell apart (a crossing at a shallow angle).
/// `ofBundles`: all the crossings of overdrawn strokes with others too.
/// @param choices of the user: where one is meant for a junction of a tangle (tangles.h), that is left as it is.
void mergeJunctions(SkeletonGraph& graph, bool ofBundles, std::span<const JunctionChoice> choices);

}  // namespace batten
