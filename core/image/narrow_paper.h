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

}  // namespace batten
