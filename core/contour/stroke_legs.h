// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/contour/stroke_cover.h"

namespace batten {

/// A stretch of a mean line between two nodes; its ends are numbered 2 * leg + side.
struct MeanLeg {
  MeanLine line;
  int node[2] = {-1, -1};  ///< -1: the line ends there.
  double length = 0.0;     ///< [px]
  bool alive = true;
};

/// Mean lines as a graph: legs, and for every node the ends that meet there.
struct MeanLegs {
  std::vector<MeanLeg> legs;
  std::vector<std::vector<int>> nodes;
  void add(MeanLine line, int from, int to);
  void remove(int leg);
};

/// Cuts the pieces where others are attached; what is nearer than the distance along a piece is one node.
MeanLegs legsOf(StrokePieces pieces, double distancePx);

}  // namespace batten
