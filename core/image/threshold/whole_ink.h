// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/threshold/level_masks.h"

namespace batten {

/// Torn ink is smoothed, for the page as a whole, which fills the counters of small letters and joins what lies close
/// together. Pieces of ink so narrow that this rounds them off, among ink that is not torn, are taken from a page that
/// was smoothed less.
/// @param smoothed after a Gaussian of `smoothingPx` [px].
/// @param fine the same masks of the same page, smoothed less.
/// @return `smoothed` as it was when cancelled.
LevelMasks withWholePieces(LevelMasks smoothed, double smoothingPx, const LevelMasks& fine, const RunContext& context);

}  // namespace batten
