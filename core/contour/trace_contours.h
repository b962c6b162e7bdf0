// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"
#include "core/image/bits/bit_image.h"
#include "core/image/fine_page.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// Finds the lines of a page: outlines by crack following, centre lines by thinning, both refined on the raw grey
/// values. The mask gives the topology only; positions come from `grey` if EdgeParams::subpixel is on.
/// @param fine where strokes are thin: the topology comes from its mask instead, the positions from `grey` all the
/// same.
/// @param paper where strokes are not thin: by it paper is found that strokes of a pen have closed (ink/ink_split.h).
/// @return NoCurve, with advice, if no line is long enough.
Result<ContourSet> traceContours(const BitImage& ink, const GreyImage& grey, const EdgeParams&, const ContourParams&,
                                 const RunContext&, const FinePage* fine = nullptr,
                                 const PaperBackground* paper = nullptr);

}  // namespace batten
