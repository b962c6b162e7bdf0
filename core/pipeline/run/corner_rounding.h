// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/pipeline/run/pipeline.h"

namespace batten {

/// Rounds the marked corners that have a size (002 figure 6): the faired curves on both sides are cut short by that
/// length, at most 45 % of either, and two typical curves lead from one to the other. Each curve takes the half next to
/// it, so that curves and pieces stay one to one and still meet where the corner was. Whatever method made the curves.
/// A corner that cannot be rounded stays sharp, and the notes of its curves say so. The figures of rounded curves are
/// those of what is exported: their distance from the edge points includes the corner that is cut off. Cancelled: no
/// further corner is rounded.
void roundCorners(FairedSet&, const PieceSet&, const Recipe&, const PageFrame&, const RunContext& context = {});

}  // namespace batten
