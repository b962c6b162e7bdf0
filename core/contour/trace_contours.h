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

/// What is known of a page beside its ink; absent: nothing.
struct PageAids {
  const FinePage* fine = nullptr;  ///< Where strokes are thin: the topology comes from its mask, the positions from the
                                   ///< grey of the page all the same.
  const PaperBackground* paper = nullptr;  ///< Where they are not: by it paper is found that strokes of a pen have
                                           ///< closed (ink/ink_split.h).
};

/// Finds the lines of a page: outlines by crack following, centre lines by thinning, both refined on the raw grey
/// values. The mask gives the topology only; positions come from `grey` if EdgeParams::subpixel is on.
/// @return NoCurve, with advice, if no line is long enough.
Result<ContourSet> traceContours(const BitImage& ink, const GreyImage& grey, const EdgeParams&, const ContourParams&,
                                 const RunContext&, const PageAids& aids = {});

}  // namespace batten
