// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/contour/centreline/stroke_paths.h"
#include "core/image/grey_image.h"

namespace batten {

/// Joins stroke paths through the ink of others: a stroke that crosses a bundle, or several lines at a shallow angle,
/// comes out on the other side. Ends at junctions that the user paired stay as they are. Joined paths are left empty.
void joinThroughInk(std::vector<StrokePath>& paths, const std::vector<bool>& pencil,
                    std::span<const StrokeJunction> junctions, const BitImage& ink, const GreyImage& grey,
                    const EdgeParams& params, const RunContext& context);

/// Drops empty paths and joins stroke paths over gaps: mutually nearest free ends that look at each other. How long a
/// gap is (EdgeParams::gapFactor) is measured from ink to ink. Strokes too short to have a direction are not joined,
/// nor such as differ much in width, but for those of a pencil, whose grain makes both.
/// @param pencil whether each path was drawn with a pencil.
void bridgeGaps(std::vector<StrokePath>& paths, const std::vector<bool>& pencil, const BitImage& ink,
                const GreyImage& grey, const EdgeParams& params, const RunContext& context);

}  // namespace batten
