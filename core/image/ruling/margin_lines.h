// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/ruling/ruling_lattice.h"
#include "core/image/ruling/ruling_stretches.h"

namespace batten {

/// Lines that may be the margin of ruled paper, each as a lattice of one line: they run along x through the whole
/// plane, nearly straight, in the outer three tenths.
/// @param found the stretches of the plane. @param spacing [grid] of the ruled lines across them.
std::vector<RulingLattice> findMarginLines(const PlaneView& grey, const RulingStretches& found, double spacing,
                                           const RunContext& context);

}  // namespace batten
