// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/plane.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

struct OtsuThresholds {
  RegionThresholds thresholds;  ///< Its automatic, measured, foundLine and smoothingPx.
  int split = 0;                ///< Regions that were parted into two greys.
  int mostlyDark = 0;           ///< Of those, how many have mostly dark pixels.
  double separation = 0.0;      ///< Mean share of the variance that lies between the two greys, 0..1.
};

/// [px] Standard deviation of the least Gaussian before thresholding: it spares lines 3 px from middle to middle.
inline constexpr double kFineSmoothingPx = 0.72;

/// The thresholds without paper flattening: Otsu in each region, believed only where it parts two clearly different
/// greys; the other regions are filled from these.
/// @param smoothed by a Gaussian of `smoothingPx`.
OtsuThresholds otsuThresholds(const Plane& smoothed, double smoothingPx, double strength, const RunContext& context);

/// The same on the full picture with the least smoothing, for lines so close that more would make one grey of them.
/// Asks for a clearer parting, since noise is smoothed less, too.
OtsuThresholds fineOtsuThresholds(const GreyImage&, double strength, const RunContext& context);

/// The same with hardly any smoothing, for hairlines closer than that: in regions whose grey runs along lines, as that
/// of hatching does and noise does not.
OtsuThresholds hatchingThresholds(const GreyImage&, double strength, const RunContext& context);

}  // namespace batten
