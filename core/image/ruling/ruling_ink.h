// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/plane.h"
#include "core/image/ruling/ruling_lattice.h"

namespace batten {

/// How much of the length of a lattice's lines holds ink, where they are there at all: near 1 for ruled lines, whose
/// ink goes on, about half for rows of letters, of dots or of crossings. The median over the stretches of lines that
/// are seen; 0 without any.
double inkAlongLines(const Plane& grey, const RulingLattice& lattice, const RunContext& context);

/// How dark a lattice's lines are, and what lies in the middle between them.
struct LatticeContrast {
  /// Share of the contrast between the lines and the middle between them that is left when both are averaged along the
  /// lattice: most of it for lines that run along it, nothing for any that it crosses, as hatching a few pixels apart,
  /// which a short look at any of its columns takes for lines.
  double along = 0.0;
  /// Depth of a line in the middle between the lattice's, as a part of theirs: about 1 if these are every other line of
  /// twice as many.
  double between = 0.0;
};
LatticeContrast contrastOf(const Plane& grey, const RulingLattice& lattice);

}  // namespace batten
