// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_line.h"
#include "core/fairing/model/fairing_setup.h"

namespace batten {

/// TolerancePolicy::AsNeeded: the integral is weighed against the distance from the line's points. The weight is where
/// the misfit of the points is that of their own noise (Mallows' Cp); then curvature extrema go, cheapest first, as
/// long as the misfit rises by less than noise explains. The curve gets no more extrema than the sketch. Without
/// points: the nearest curve found with the fewest extrema within the tolerance (StructureCandidates).
Result<FairedCurve> fairAsNeeded(const std::shared_ptr<const FairingSetup>& setup, const FairingParams& params,
                                 const FairingLine& line, const RunContext& context);

}  // namespace batten
