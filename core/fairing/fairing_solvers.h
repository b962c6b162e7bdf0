// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing_problem.h"

namespace batten {

/// modifyShape and fairWithinTolerance on a setup that several fairings share.
Result<FairedCurve> modifyShape(const FairingSetup& setup, const TargetProfile& profile, double toleranceMm,
                                const RunContext& context);
Result<FairedCurve> fairWithinTolerance(const FairingSetup& setup, double toleranceMm, const RunContext& context);
/// Tolerance mode, TolerancePolicy::AsNeeded.
Result<FairedCurve> fairAsNeeded(const FairingSetup& setup, const FairingParams& params, const FairingLine& line,
                                 const RunContext& context);

/// The smallest misfit with every sample's distance from the sketch bounded, by a logarithmic barrier (interior point)
/// from control points inside the bound. Slower than one weight, but sure to use the whole corridor.
struct BoundedRun {
  std::vector<Vec2> points;
  Termination why = Termination::IterationLimit;
  int iterations = 0;
};
BoundedRun minimiseWithin(const FairingSetup& setup, const FairingObjective& objective, double toleranceMm,
                          const std::vector<Vec2>& points, const RunContext& context);

/// Runs `body` on the curve's setup. Curves that cannot be made fair stay as they are when the reason lies in their
/// shape.
Result<FairedCurve> withSetup(const NurbsCurve& curve, bool closed, const FairingParams& params,
                              const std::function<Result<FairedCurve>(const FairingSetup&)>& body);

/// The curve as sketched, with the reason why nothing was done.
FairedCurve unchanged(const NurbsCurve& curve, bool closed, Termination why, std::string note);

/// The share of the way from the sketched curve to `points` that stays within the tolerance, measured both ways on the
/// whole curve; `points` are moved there. @return the largest deviation.
double keepWithin(const FairingSetup& setup, double toleranceMm, std::vector<Vec2>& points);

/// Fills in what the report says of the curves: deviation, extrema.
Result<FairedCurve> finished(const FairingSetup& setup, std::vector<Vec2> points, double toleranceMm,
                             FairingReport report);

}  // namespace batten
