// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/model/fairing_state.h"

namespace batten {

/// TolerancePolicy::All: the smallest integral of (dkappa/ds)^2 with the deviation bounded by the tolerance, all of
/// which is spent, among the curves with the fewest extrema within it (StructureCandidates).
Result<FairedCurve> fairWithinTolerance(const std::shared_ptr<const FairingSetup>& setup, const FairingParams& params,
                                        const RunContext& context);

/// The smallest misfit with every sample's distance from the sketch bounded, by a logarithmic barrier (interior point)
/// from control points inside the bound. Slower than one weight, but sure to use the whole corridor.
struct BoundedRun {
  std::vector<Vec2> points;  ///< Control points. [mm]
  Termination why = Termination::IterationLimit;
  int iterations = 0;
};
BoundedRun minimiseWithin(const FairingSetup& setup, const FairingObjective& objective, double toleranceMm,
                          const std::vector<Vec2>& points, const RunContext& context);

}  // namespace batten
