// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"

namespace batten {

/// Target mode with polynomials: the degree that is asked for, or else the one to recommend, and targets of single
/// spans.
Result<FairedCurve> fairToTarget(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&);

}  // namespace batten
