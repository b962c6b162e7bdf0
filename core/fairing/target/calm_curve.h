// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/cancel_check.h"
#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"

namespace batten {

/// The curve that targets are fitted to: the curve itself, or for one with more curvature extrema than can be followed
/// (kMostSplits) the nearest curve over so few knots that it explains the curve best by AICc, the number of its control
/// points being that of the data. What a hand trembles is not in it. One polynomial for the whole curve, and radii, are
/// fitted to the curve itself, as in the papers.
NurbsCurve withoutTremor(const NurbsCurve&, bool closed, const FairingParams&, CancelCheck check = {});

}  // namespace batten
