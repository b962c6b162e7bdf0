// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"

namespace batten {

/// The nearest curve whose curvature is monotone, or monotone between the extrema that are kept (fairing.keepExtrema,
/// keptAt): as the papers call a curve fair, and what their polynomials do not achieve. Extrema are dropped in the
/// order of how little that moves the curve. What the tolerance does not permit is not done: then the fewest extrema
/// above those asked for are kept, and the report's note, `neededMm` and `withinTolerance` tell what would take more.
/// What a number of extrema needs is one figure for a curve, the least that any search has found, and every curve
/// within a smaller tolerance may be taken within a larger one. Of equally many extrema the curvature turns back as
/// seldom as can be, however little; of these the nearest curve is taken.
Result<FairedCurve> fairMonotone(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&);

}  // namespace batten
