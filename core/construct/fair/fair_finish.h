// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/construct/fair/fair_piece.h"

namespace batten {

/// The rest, once noise and cut-off are known and `rough` is set: sets `result`, `squares` and `pointCount`. Leaves
/// `result` absent when cancelled. `willBeCut`: a piece whose smoothing already leaves its points will be cut there and
/// fitted again, and gets no more than that smoothing.
void finishFairPiece(FairPiece&, const ConstructPiece&, double pixelMm, double s0, double cutoffPx, bool willBeCut,
                     const FairFitOptions&, const RunContext&);

}  // namespace batten
