// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/cancel_check.h"
#include "core/construct/fair/fair_structure.h"

namespace batten {

/// Where the constraints of a structure act the curvature of `fit` is a staircase of plateaus. Asks every stretch for a
/// part of its mean slope all along, as far as that raises the penalised chi2 of the stretch by no more than noise is
/// (a line that was drawn with an arc in it keeps its arc), and solves again. Sets structure.leastSlope. Returns `fit`
/// where nothing can be had.
StructureFit withoutPlateaus(const FairFrame&, const FairPosterior&, FairStructure&, StructureFit fit, CancelCheck);

}  // namespace batten
