// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/construct/fair/fair_piece.h"

namespace batten {

/// What is known of a piece when it is finished.
struct FairNoise {
  double s0 = 0.0;        ///< [px^2 px] noise density.
  double cutoffPx = 0.0;  ///< Cut-off wavelength of the prior.
  /// A piece whose smoothing already leaves its points will be cut there and fitted again, and gets no more than that
  /// smoothing.
  bool willBeCut = false;
};

/// The rest, the structure of its curvature and knot removal (fewest_knots.h), once noise and cut-off are known and
/// `rough` is set: sets `result`, `squares` and `pointCount`. Leaves `result` absent when cancelled.
void finishFairPiece(FairPiece&, const ConstructPiece&, const FairNoise&, const FairFitOptions&, const RunContext&);

}  // namespace batten
