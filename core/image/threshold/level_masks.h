// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// ThresholdParams::reach, chosen by the program: never into the noise of the paper.
inline constexpr double kAutomaticReach = 0.4;

/// The smoothed page compared with three levels: paper plus the contrast of the regions, made deeper or weaker.
struct LevelMasks {
  BitImage ink;                     ///< Darker than the level of its region.
  std::optional<BitImage> certain;  ///< Darker than the deeper level, where requested.
  std::optional<BitImage> faint;    ///< Darker than the weaker level, where requested.
};

/// Smooths the page by the thresholds' Gaussian and compares it with its levels, in float. A place whose darkest
/// neighbour is brighter than the level is not looked at: a mean with positive weights is never darker than its darkest
/// pixel, so this changes no bit.
LevelMasks compareWithLevels(const GreyImage&, const RegionThresholds&, const ThresholdParams&, const RunContext&);

}  // namespace batten
