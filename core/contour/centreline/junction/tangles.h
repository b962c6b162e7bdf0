// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "core/contour/centreline/skeleton/skeleton_graph.h"

namespace batten {

/// Three strokes or more that cross, touch or lie on one another: junctions that hang together by common ink.
struct Tangle {
  std::vector<int> nodes;                    ///< That become one.
  std::vector<int> inner;                    ///< Edges between them.
  std::vector<int> outer;                    ///< The ends that leave them, ascending.
  std::vector<std::pair<int, int>> strokes;  ///< Pairs of outer ends.
  std::vector<JunctionDisc> discs;           ///< Of each outer end: up to where its stroke has no middle of its own.
  bool isDoubtful = false;                   ///< Another pairing would do too.
};

/// Tangles whose strokes are told by their ends: over all of a tangle at once, every end but one of an odd number goes
/// on to another by an arc of a circle that runs within the ink, and the arcs together explain all of it. What is not
/// so clear is no tangle.
/// A stretch of one stroke alone between its crossings keeps its own middle, however bold the stroke is.
std::vector<Tangle> findTangles(const SkeletonGraph& graph);

}  // namespace batten
