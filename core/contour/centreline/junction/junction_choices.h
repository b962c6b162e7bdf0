// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/contour/centreline/skeleton/skeleton_graph.h"
#include "core/contour/contour_set.h"

namespace batten {

/// For every node of the graph the index of the choice that it follows.
std::vector<std::optional<int>> choicesOfNodes(const SkeletonGraph& graph, std::span<const JunctionChoice> choices);

/// The pairs of a choice as indices into the ends of a node, each end given by the points of its edge from the node on.
/// A pair of which a place lies on no branch here is left out.
EndPairs chosenPairs(const JunctionChoice& choice, std::span<const EdgeFromEnd> ends);

/// The junctions that the user has paired, and those of which three branches or more belong to one of the lines.
std::vector<StrokeJunction> junctionsOfLines(std::vector<StrokeJunction> junctions, std::span<const Contour> lines);

}  // namespace batten
