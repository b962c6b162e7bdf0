// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/centreline/graininess.h"
#include "core/image/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// What following lines in all directions tells about ink that was closed.
struct OrientedLines {
  /// Paper between lines that run side by side: where the mean along some direction is clearly brighter than the same
  /// at either side, farther off than a line reaches, and no direction is as dark as these. Grain within one line has
  /// no line beside it.
  BitImage gaps;
  /// Where a line runs on: the means ahead and behind are both clearly darker than what lies at the sides.
  BitImage lines;
};
/// `body` and what is near it is searched for lines about as wide as `widthPx`. How much is clear follows from the
/// grain and the noise at the place. Nothing is found for strokes of more than 24 px. May throw std::bad_alloc. Not
/// complete when cancelled.
OrientedLines filterOrientedLines(const BitImage& body, const GreyImage& grey, const GraininessMap& grain,
                                  double widthPx, const RunContext& context);

}  // namespace batten
