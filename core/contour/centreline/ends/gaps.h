// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// What stroke paths are followed on.
struct FollowedInk {
  const BitImage& ink;
  const GreyImage& grey;
  const std::vector<bool>& pencil;  ///< Whether each path was drawn with a pencil.
};

/// Joins stroke paths through the ink of others: a stroke that crosses a bundle, or several lines at a shallow angle,
/// comes out on the other side. Ends at junctions that the user paired stay as they are. Joined paths are left empty.
void joinThroughInk(std::vector<StrokePath>& paths, const FollowedInk& followed,
                    std::span<const StrokeJunction> junctions, const EdgeParams& params, const RunContext& context);

/// Drops empty paths and joins stroke paths over gaps: mutually nearest free ends that look at each other. How long a
/// gap is (EdgeParams::gapFactor) is measured from ink to ink. Strokes too short to have a direction are not joined,
/// nor such as differ much in width, but for those of a pencil, whose grain makes both.
void bridgeGaps(std::vector<StrokePath>& paths, const FollowedInk& followed, const EdgeParams& params,
                const RunContext& context);

}  // namespace batten
