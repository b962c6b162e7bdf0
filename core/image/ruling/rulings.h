// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// One printed line of ruled paper or of a grid.
struct RulingLine {
  std::vector<Vec2> coursePx;  ///< Its middle, from end to end, image frame.
};

/// Lines side by side at equal spacing over the page, or over one of the pages that lie side by side on it.
struct RulingFamily {
  bool runsDown = false;   ///< More down the page than across it.
  double spacingPx = 0.0;  ///< Mean distance of neighbours.
  double widthPx = 0.0;    ///< Median over the lines.
  double depth = 0.0;      ///< 0..1: how much of the paper's light a line takes, at its middle.
  bool isBroken = false;   ///< As dark as ink, and copied: lines fade and break off, and shapes lie over them.
  std::vector<RulingLine> lines;
};

}  // namespace batten
