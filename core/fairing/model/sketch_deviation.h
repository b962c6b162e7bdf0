// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

struct FairingSetup;

/// Largest distance [mm] of the curve of these control points from the sketched one: foot points at 12 places a span
/// or, where the two swing apart quickly, so many that no more than 1 % can hide between them; over fewer knots, at 12
/// places a sketched span. `bothWays` also measures the sketched curve's distance from the curve. @return where it is
/// more than `enoughMm` maybe less than all of it, but more than that.
double largestDeviation(const FairingSetup& setup, const std::vector<Vec2>& points, bool bothWays = false,
                        double enoughMm = std::numeric_limits<double>::infinity());

/// Whether that is less than `mm`, both ways, by 2 % or more: this takes a fraction of the time, as feet are looked for
/// only where the curve may be as far off.
bool isClearlyWithin(const FairingSetup& setup, const std::vector<Vec2>& points, double mm);

}  // namespace batten
