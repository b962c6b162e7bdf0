// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

struct FaintMarks {
  BitImage ink;
  int count = 0;  ///< Pieces in it.
};

/// Pieces of `marks` shorter than three pen widths that would be no ink at the threshold of the strokes around them:
/// grain of the paper and dirt, on regions whose own threshold follows nothing but that. A dot of the same pen or
/// pencil is about as dark as its strokes. None where there are no lines to compare with,
/// or no strokes.
/// @param ink all ink: what is not, is paper. @param penPx [px] the width of the strokes; absent: there are none.
FaintMarks faintMarks(const BitImage& marks, const BitImage& ink, const ContourSet& lines, const GreyImage& grey,
                      std::optional<double> penPx, const RunContext& context);

}  // namespace batten
