// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// The profile that a curve was made fair towards, over its whole perimeter: the polynomials of its natural spans or
/// splits, of the parts between its corners, of the spans that alone were moved (elsewhere the curve's own curvature),
/// the drawn or the log-aesthetic profile. Absent for other modes, and where its parts followed different degrees.
/// @param start the curve that fairing began with.
/// @param report of that fairing.
std::optional<TargetProfile> followedTarget(const NurbsCurve& start, bool closed, const FairingParams&,
                                            const FairingReport& report);

}  // namespace batten
