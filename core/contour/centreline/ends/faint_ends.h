// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// Where the chosen strokes go on beyond their free ends over ink too weak for the threshold: trails as wide as the
/// strokes. An end is followed, step by step in the direction that is darkest against both its sides, as far as the
/// steps together are clearly darker than the best that such a search finds on the paper around, and no farther than
/// three times the length of its stroke. Where other ink continues the trail, half as much is enough. Nothing begins on
/// weak ink.
/// @param isChosen by index of the path.
/// @param pixelsPerPx of ink and grey, along a pixel of the page (fine_page.h).
BitImage followFaintEnds(const std::vector<StrokePath>& paths, const std::function<bool(int)>& isChosen,
                         const BitImage& ink, const GreyImage& grey, const RunContext& context,
                         double pixelsPerPx = 1.0);

}  // namespace batten
