// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/centreline/stroke_paths.h"
#include "core/image/grey_image.h"

namespace batten {

/// Joins stroke paths over gaps: mutually nearest free ends that look at each other. How long a gap is
/// (EdgeParams::gapFactor) is measured from ink to ink.
void bridgeGaps(std::vector<StrokePath>& paths, const BitImage& ink, const GreyImage& grey, const EdgeParams& params,
                const RunContext& context);

}  // namespace batten
