// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/profile/radius_target.h"

namespace batten {

/// Shares of the arc length, ascending and inside 0..1, of the curvature extrema whose removal would move the curve by
/// a tenth of the tolerance or more (the estimate of structureLevels). So that they do not change with every step of a
/// slider, the tolerance counts as the next lower one of the series 1, 2, 5, 10 …
std::vector<double> naturalSplits(const NurbsCurve&, bool closed, double toleranceMm);

/// The same for this and every smaller tolerance of the series, without repetitions, fewest splits first. Never empty.
std::vector<std::vector<double>> naturalSplitLevels(const NurbsCurve&, bool closed, double toleranceMm);

/// The part between two splits in which a place lies; with one split or none of a closed curve all of it.
ProfileSpan spanBetween(const std::vector<double>& splits, double at, bool closed);

}  // namespace batten
