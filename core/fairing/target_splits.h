// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/cancel_check.h"
#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/target/log_aesthetic.h"

namespace batten {

/// Where the targets of a curve are split: as the parameters say, or at its natural spans, and at sharp corners inside
/// it (a closed curve that begins at one: also at 0).
std::vector<double> targetSplits(const NurbsCurve&, bool closed, const FairingParams&, CancelCheck check = {});

/// The log-aesthetic profile that a curve is asked to follow, between its splits.
LogAestheticTarget logAestheticOf(const NurbsCurve&, bool closed, const FairingParams&, CancelCheck check = {});

}  // namespace batten
