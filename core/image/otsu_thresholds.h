// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/plane.h"
#include "core/image/region_thresholds.h"

namespace batten {

/// The thresholds without paper flattening: Otsu in each region, believed only where it parts two clearly different
/// greys; the other regions are filled from these. Fills automatic, measured and foundLine.
void otsuThresholds(const Plane& smoothed, double strength, RegionThresholds& out, const RunContext& context);

}  // namespace batten
