// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/fairing/model/fairing_setup.h"

namespace batten {

/// Starts over fewer and fewer knots for a sketched curve, fewest first: quintics with simple knots, nearest to it by
/// least squares at equal shares of the arc length, its ends and what is held there kept. Half of the breakpoints
/// lie evenly, half where the sketched curve has its own. Tremor of the hand that a sketch of many knots follows is not
/// in them. Sketches of a few knots have none.
std::vector<std::shared_ptr<const FairingSetup>> coarseSetups(const std::shared_ptr<const FairingSetup>& sketch);

/// The one of so many spans; null where there is none.
std::shared_ptr<const FairingSetup> coarseSetup(const std::shared_ptr<const FairingSetup>& sketch, int spans);

/// Of a sketch that trembles: starts over fewer and fewer spans, each with less than half the curvature extrema of the
/// one before it, until a few extrema are left.
std::vector<std::shared_ptr<const FairingSetup>> calmSetups(const std::shared_ptr<const FairingSetup>& sketch);

}  // namespace batten
