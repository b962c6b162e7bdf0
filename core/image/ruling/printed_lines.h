// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/image/plane.h"
#include "core/image/ruling/ruling_lattice.h"

namespace batten {

/// How the lines of a lattice look, each the median over the places at which they are seen.
struct LineLook {
  double width = 0.0, depth = 0.0;  ///< [grid] at half depth, and share of the paper's light.
};

/// A lattice with the look of its lines.
struct FoundLattice {
  RulingLattice lattice;
  LineLook look;
  int fromX = 0, toX = 0;  ///< [grid] Columns that its lines run through.
};

/// Whether lines as dark as ink have more to say for a print than their spacing: no hand draws so many lines so evenly,
/// they are thinner than the strokes beside them, and these go over them as if they were not there.
bool areUnderTheDrawing(const Plane& grey, const FoundLattice& found);

/// Dark lines are a drawing unless they make a grid, fill the page without a gap, or lie under the drawing. The teeth
/// of a comb are drawn: they end on the page and are joined by a stroke across.
bool isPrinted(const Plane& grey, const FoundLattice& found, bool isGrid);

}  // namespace batten
