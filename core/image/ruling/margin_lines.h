// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/ruling/ruling_lattice.h"
#include "core/image/ruling/ruling_stretches.h"

namespace batten {

/// Lines that may be the margin of ruled paper, each as a lattice of one line: they run along x, nearly straight, in
/// the outer three tenths of the plane, across all the ruled lines and on beyond the first and the last of these. The
/// plane may show more than the sheet.
/// @param found the stretches of the plane. @param ruled the ruled lines, whose place is x of the plane.
std::vector<RulingLattice> findMarginLines(const PlaneView& grey, const RulingStretches& found,
                                           const RulingLattice& ruled, const RunContext& context);

}  // namespace batten
