// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// Of the ink: holes that make up more of it are no noise but the paper between lines that cross a few pixels apart.
/// The grain of charcoal and pencil leaves less than a hundredth.
inline constexpr double kMeshShare = 0.25;

/// Ink = darker than the threshold at that place (000 II.B): 1 where grey < level, level being the region's (blocks) or
/// the bilinear surface through the region centres, relative to the local paper where it was flattened. Specks and
/// small holes are removed as the parameters say.
/// @param pixelsPerPx of the picture, along a pixel of the page (fine_page.h); the areas of the parameters are in
/// pixels of the picture.
Result<BitImage> binarize(const GreyImage&, const RegionThresholds&, const ThresholdParams&, const RunContext&,
                          int pixelsPerPx = 1);
/// The same of a whole page, with the lines that the grain of its paper hides from thresholds (lines_in_grain.h).
Result<BitImage> binarizePage(const GreyImage&, const RegionThresholds&, const ThresholdParams&, const RunContext&);

}  // namespace batten
