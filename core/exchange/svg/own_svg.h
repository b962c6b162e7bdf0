// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "core/base/vec2.h"
#include "core/curve/imported_line.h"

namespace batten {

/// What the paths of one of Batten's SVG files still have to do with the exact curves of its metadata.
struct OwnSvgLines {
  std::vector<ImportedLine> lines;  ///< One for every path, in the order of the paths.
  int drawn = 0;                    ///< Paths that are no picture of an exact curve (any more): as they are drawn.
  int gone = 0;                     ///< Exact curves without a matching path.
};

/// Takes the exact curve for every path that lies on one: same start and direction, no farther off than
/// `toleranceMm` anywhere. Other paths were changed or added by another program and stay what they are.
/// @param exact of the metadata.
/// @param drawn as read from the paths, in the same frame, mm.
OwnSvgLines exactWhereUnchanged(std::vector<ImportedLine> exact, std::vector<ImportedLine> drawn, double toleranceMm);

/// [mm] How far the paths of such a file may lie from its exact curves: what its description states, and the rounding
/// of a program that wrote it again.
double statedPathTolerance(std::string_view svg);

}  // namespace batten
