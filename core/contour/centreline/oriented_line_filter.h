// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/centreline/graininess.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// Paper between parallel lines in ink that was closed: the mean along some direction is clearly brighter than the
/// means at both sides, and no direction is as dark as those. Grain within a line is not flanked by lines, and where a
/// line runs on between others, dark ahead and behind, there is none. Searches `body` and its surroundings for lines
/// about `widthPx` wide; the least contrast follows from grain and noise at the place. Finds nothing for strokes wider
/// than 24 px of the page. May throw std::bad_alloc. Not complete when cancelled.
/// @param pixelsPerPx of body and grey, along a pixel of the page (fine_page.h).
BitImage gapsBetweenLines(const BitImage& body, const GreyImage& grey, const GraininessMap& grain, double widthPx,
                          const RunContext& context, int pixelsPerPx = 1);

/// to[i] = the sum of grey[i + step] over the steps, in their order, for i < count.
using StepSums = void (*)(const float* grey, const int* steps, int stepCount, int count, float* to);
/// For any processor.
StepSums plainStepSums();
/// The fastest that this processor has; the same bits.
StepSums stepSums();

}  // namespace batten
