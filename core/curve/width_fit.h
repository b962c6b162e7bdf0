// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/base/cancel_check.h"
#include "core/curve/width_profile.h"

namespace batten {

/// The fewest samples that say of widths what is not noise.
/// @param measured in any order.
/// @param length of the curve. > 0.
/// @param closed the end goes on at the start, and has its width.
/// @param pixel the unit of noise, and about the distance of neighbouring measurements. > 0.
/// @pre at least one measurement. When the run is cancelled, the profile is of no use.
WidthProfile fittedWidths(std::span<const WidthSample> measured, double length, bool closed, double pixel,
                          CancelCheck check = {});

}  // namespace batten
