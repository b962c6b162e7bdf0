// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/intent/stroke_groups.h"

namespace batten {

/// One line for each intended curve, however often it was drawn over and in however many strokes. The lines are
/// cut where they may have gone from one curve into another (stroke_pieces.h), the pieces grouped by place, without one
/// distance for the page (stroke_groups.h), and every group replaced by its mean, with the spread of its strokes as the
/// bundle of its points. A group of pieces that follow each other on one line stays as it was traced. What is left of a
/// line between others that already explain it is dropped.
/// @param lines centre lines that were not merged; bridged gaps are opened first. Others are ignored.
/// @param widthPx > 0, of the pen.
/// @param scaleWidths [stroke widths] > 0, the distance for merging that suits the page as a whole; absent: found.
/// @param probe for learning weights (stroke_groups.h).
/// @return nothing where the page shows no overdrawn lines, or when cancelled. Same result with any number of threads.
std::optional<std::vector<Contour>> intendedLines(const std::vector<Contour>& lines, double widthPx,
                                                  std::optional<double> scaleWidths, const RunContext& context,
                                                  const GroupingProbe& probe = {});

}  // namespace batten
