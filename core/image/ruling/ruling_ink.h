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

}  // namespace batten
