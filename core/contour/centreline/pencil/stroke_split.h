// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Both have the size of the ink that was split.
struct StrokeSplit {
  BitImage strokes;
  BitImage shapes;
};
/// Splits the ink piece by piece: one is a shape when more than half of its area survives an opening by a disc that is
/// far wider than a stroke on a page of this size.
Result<StrokeSplit> splitStrokes(const BitImage& ink, const RunContext&);

}  // namespace batten
