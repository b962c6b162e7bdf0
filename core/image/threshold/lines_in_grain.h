// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// Adds to the ink the lines that grainy paper hides: where the noise of the paper asks faint lines for more contrast
/// than ThresholdParams::reach does, single pixels tell no line, but means along it do, of which the grain is as much
/// less as the line is long. A line is darker than both its sides by more than the grain of this paper makes of the
/// same means, and by the reach; what goes on with such a place may be fainter. Other pages stay as they are.
/// @param image without folds.
/// @return `ink` as it was when cancelled.
BitImage addLinesInGrain(BitImage ink, const GreyImage& image, const RegionThresholds&, const ThresholdParams&,
                         const RunContext&);

}  // namespace batten
