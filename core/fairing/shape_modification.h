// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/fairing_setup.h"
#include "core/fairing/radius_target.h"

namespace batten {

/// Moves the control points until the curvature follows the profile as far as the tolerance allows (000 VII, 003
/// section 4): Levenberg-Marquardt with the end points pinned in a null-space basis, fidelity weight by bisection.
/// Periodic curves stay periodic (`closed`). Knots stay as they are. Never returns a curve that leaves the tolerance.
Result<FairedCurve> modifyShape(const NurbsCurve&, bool closed, const TargetProfile&, const FairingParams&,
                                const RunContext&);

/// The same on a setup that several fairings share.
Result<FairedCurve> modifyShape(const FairingSetup& setup, const TargetProfile& profile, double toleranceMm,
                                const RunContext& context);

}  // namespace batten
