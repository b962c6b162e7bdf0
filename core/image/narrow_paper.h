// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// The ink of a fine page (fine_page.h) without the paper between thin strokes that no threshold tells from ink,
/// because it takes the blur of both: the counters of small letters, the space between two letters. It is clearly
/// brighter than the ink close by on two opposite sides. What is darker than its surroundings across that direction is
/// the faint middle of a bar and stays. Single pixels are grain and stay, too. Unfinished when cancelled.
BitImage withoutNarrowPaper(BitImage ink, const GreyImage&, const PaperBackground&, const RunContext&);

/// What the paper lies between.
enum class PaperBetween { Strokes, Letters };

/// The same on a page as it is, for paper between the strokes of a pen that lies in their blur or in a shadow, so that
/// a threshold low enough for faint lines takes it for ink: in lettering, in the dense parts of a technical drawing. It
/// is looked for where the ink is broader than a stroke, and must be somewhat more than a stroke's width from ink to
/// ink, somewhere: strokes that leave less were often drawn over one another. In letters half a width is enough.
/// @param penPx [px] width of the strokes in this ink.
BitImage withoutClosedPaper(BitImage ink, const GreyImage&, const PaperBackground&, double penPx, const RunContext&,
                            PaperBetween between = PaperBetween::Strokes);

/// Paper within the dark ink of a pencil that is nearly as bright as the sheet, at places between ink: in lettering,
/// where the smoothing that torn ink needs has filled it. Grain is smaller, or fainter.
/// @param penPx [px] width of the strokes in this ink. @return a part of the ink. Unfinished when cancelled.
BitImage clearPaper(const BitImage& ink, const GreyImage&, const PaperBackground&, double penPx, const RunContext&);

}  // namespace batten
