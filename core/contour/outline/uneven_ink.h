// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// Notes on the borders whose ink is uneven (Contour::isUneven): dry brush, chalk, the tone of a pencil. The ink just
/// inside such a border varies by a good part of its contrast to the paper just outside; solid ink varies by the noise
/// of the scan alone. Where most borders of a page are so, less tells: one tool drew them. @param ink that the borders
/// enclose. @pre ink and grey have the same size.
/// Unfinished when cancelled.
void noteUnevenInk(ContourSet& borders, const BitImage& ink, const GreyImage& grey, const RunContext& context);

}  // namespace batten
