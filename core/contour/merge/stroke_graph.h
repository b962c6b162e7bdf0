// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/contour/merge/overlap_removal.h"

namespace batten {

/// A stretch of a mean line between two nodes; its ends are numbered 2 * edge + side.
struct GraphEdge {
  MeanLine line;
  std::array<std::optional<int>, 2> node;  ///< At the start and the end; none: the line ends there.
  double length = 0.0;                     ///< [px]
  bool alive = true;                       ///< False: dropped or joined with another.
};

/// Mean lines as a graph: edges, and for every node the ends that meet there.
struct StrokeGraph {
  std::vector<GraphEdge> edges;
  std::vector<std::vector<int>> nodes;
  void add(MeanLine line, std::optional<int> from, std::optional<int> to);
  void remove(int edge);
};

/// Cuts the pieces where others are attached; what is nearer than the distance along a piece is one node.
StrokeGraph graphOf(RemainingLines pieces, double distancePx);

}  // namespace batten
