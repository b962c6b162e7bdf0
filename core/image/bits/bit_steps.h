// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Ink grown by `steps` pixels: steps over 8 and over 4 neighbours take turns, which makes an octagon of the disc.
/// Outside the page is paper.
BitImage grown(const BitImage& image, int steps, const RunContext& context);
/// Ink whose octagon of `steps` pixels is ink altogether. Outside the page counts as ink.
BitImage shrunken(const BitImage& image, int steps, const RunContext& context);

/// a and b; a without b; a or b. @pre equal sizes.
BitImage both(BitImage a, const BitImage& b);
BitImage without(BitImage a, const BitImage& b);
BitImage either(BitImage a, const BitImage& b);
/// The pixels that are not ink.
BitImage paperOf(const BitImage& ink);

}  // namespace batten
