// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

/// One printed line of ruled paper or of a grid.
struct RulingLine {
  std::vector<Vec2> coursePx;  ///< Its middle, from border to border, image frame.
};

/// Parallel lines at equal spacing over the page.
struct RulingFamily {
  bool runsDown = false;   ///< More down the page than across it.
  double spacingPx = 0.0;  ///< Mean distance of neighbours.
  double widthPx = 0.0;    ///< Median over the lines.
  double depth = 0.0;      ///< 0..1: how much of the paper's light a line takes, at its middle.
  std::vector<RulingLine> lines;
};

/// Finds the ruled lines or the grid of the paper, also on a page that is turned by up to 11 degrees, slightly curved
/// or seen in perspective. Lines count as ruling only if they are thin, at least five, equally spaced over at least
/// half of the page and each seen along most of it; dark ones must make a grid or fill the page. At most one family
/// across and one down. Hatching, railings and grilles of a drawing are shorter or less even. Empty when cancelled.
std::vector<RulingFamily> findRulings(const GreyImage&, const RunContext&);

/// The page without its ruled lines: what a line takes of the paper's light is given back, so that strokes across it
/// keep their ink. Where a line is as dark as the strokes, ink stays where it goes on at both sides of the line.
/// @return an empty picture when cancelled.
GreyImage withoutRulings(const GreyImage&, const std::vector<RulingFamily>&, const RunContext&);

}  // namespace batten
