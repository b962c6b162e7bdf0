// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/plane.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// How many of the 64 regions were parted into two greys, in how many of those most pixels are dark, and how clearly
/// they were parted: the mean share of the variance that lies between the two greys.
struct OtsuRegions {
  int split = 0, mostlyDark = 0;
  double separation = 0.0;
};

/// [px] Standard deviation of the least Gaussian before thresholding: it spares lines 3 px from middle to middle.
inline constexpr double kFineSmoothingPx = 0.72;

/// The thresholds without paper flattening: Otsu in each region, believed only where it parts two clearly different
/// greys; the other regions are filled from these. Fills automatic, measured and foundLine.
OtsuRegions otsuThresholds(const Plane& smoothed, double strength, RegionThresholds& out, const RunContext& context);

/// The same on the full picture with the least smoothing, for lines so close that more would make one grey of them.
/// Asks for a clearer parting, since noise is smoothed less, too. Fills smoothingPx as well.
OtsuRegions fineOtsuThresholds(const GreyImage&, double strength, RegionThresholds& out, const RunContext& context);

}  // namespace batten
