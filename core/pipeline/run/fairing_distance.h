// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/cancel_check.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// [mm] How far what fairing starts from lies off the sketched curve, from which the move is measured; 0 where they are
/// one. That much of the tolerance is taken already.
double startsOffMm(const TracedCurve&, CancelCheck check = {});

/// [mm] Largest distance of a curve from the sketched one, both ways.
double movedMm(const NurbsCurve& moved, const TracedCurve&, CancelCheck check = {});

}  // namespace batten
