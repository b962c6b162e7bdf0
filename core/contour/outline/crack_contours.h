// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Follows the cracks between ink and paper: every border of every 8-connected ink component once, as a closed chain of
/// crack midpoints ((x, y) with one coordinate whole and the other at .5), outer borders and, on request, holes.
/// Refined and unrefined positions are equal, `refined` is false. Sorted by the topmost, then leftmost start, not by
/// length.
Result<ContourSet> crackContours(const BitImage& ink, bool internal, double minLengthPx, const RunContext&);

}  // namespace batten
