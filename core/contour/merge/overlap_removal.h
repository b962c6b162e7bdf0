// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/merge/stroke_mean.h"

namespace batten {

/// What is left of mean lines when none runs along another, or along itself.
struct StrokePieces {
  /// Where a piece was cut off because it goes on along another: its start (side 0) or end (1) lies on point `index`
  /// of the piece `onto` (which may be the piece itself).
  struct Attachment {
    int piece = 0, side = 0;
    int onto = 0, index = 0;
  };
  std::vector<MeanLine> pieces;
  std::vector<Attachment> attachments;
};

/// Keeps the parts of the lines that lie on no line before them; to lie on a line is to be within a part of
/// `distancePx` of it in its direction over some length, or to run beside it within `distancePx` between two places
/// (or one place and an end) where it does. Lines that cross or meet at an end are left alone. Longest first, please.
/// Not complete when cancelled.
StrokePieces removeOverlaps(std::vector<MeanLine> lines, double distancePx, const RunContext& context);

}  // namespace batten
