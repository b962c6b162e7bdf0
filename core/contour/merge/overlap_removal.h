// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/merge/stroke_mean.h"

namespace batten {

/// What is left of mean lines once their overlaps are removed.
struct RemainingLines {
  /// Where a piece was cut off because it continues along another: its start (side 0) or end (1) lies on point `index`
  /// of the piece `onto` (possibly the piece itself).
  struct Attachment {
    int piece = 0, side = 0;
    int onto = 0, index = 0;
  };
  std::vector<MeanLine> pieces;
  std::vector<Attachment> attachments;
};

/// Keeps the parts of each line that do not lie on a line before it. A stretch lies on a line if it runs in the same
/// direction within a small part of `distancePx`, or within `distancePx` between two such stretches (or such a stretch
/// and an end). Lines that cross or meet at an end stay. @pre longest first. Not complete when cancelled.
RemainingLines removeOverlaps(std::vector<MeanLine> lines, double distancePx, const RunContext& context);

}  // namespace batten
