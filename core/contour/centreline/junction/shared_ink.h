// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "core/contour/centreline/skeleton/skeleton_graph.h"

namespace batten {

/// Two strokes that lie on one another along an edge of the skeleton: they cross at a shallow angle, or touch.
struct SharedInk {
  /// The ends that each stroke comes from and goes on to, at the first and the second node of the edge.
  std::array<std::pair<int, int>, 2> strokes;
  std::array<JunctionDisc, 2> discs;  ///< Of these nodes, and where the strokes still touch beyond them.
  /// Root mean square of what two arcs leave of the strokes' courses, of their widths and of the ink's.
  double missPx = 0.0;
  bool isDoubtful = false;  ///< The other pairing would do too, or leaves little more.
};

/// Whether an edge whose nodes each have two further ends is the common ink of two strokes. The ends at one node are
/// paired with those at the other in the way in which two arcs of a circle, laid through the ends beyond the nodes,
/// leave least of them; the arcs must then run along the edge, as far to both sides of it as its ink is wider than
/// one stroke. Long edges between two branches of one stroke are no wider than the stroke: they are not shared; nor is
/// one between two branches on one side of a stroke, which look like a ring on it but leave it as wide as it is.
std::optional<SharedInk> findSharedInk(const SkeletonGraph& graph, int edge);

}  // namespace batten
