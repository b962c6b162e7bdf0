// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// Lines that were drawn in several strokes over one another.
struct OverdrawnStrokes {
  double distancePx = 0.0;  ///< [px] Between middles, for mergeStrokes().
  double share = 0.0;       ///< [-] 0..1 of the length of all lines: what lies beside a stroke of the same line.
};

/// Judges lines that run side by side by how they begin and end to do so (parallel_strokes.h). Strokes of one line
/// cross or join at a small angle, part a little and come together again, or one ends while the other continues. Two
/// separate lines part for good, run round beside each other, or end level. For every distance the length that would be
/// merged rightly is compared with the length that would be merged wrongly; the result is the middle of the best range.
/// Lines that never touch another at a small angle do not count as overdrawn, whatever their distance.
/// @param lines centre lines that were not merged; other contours are ignored.
/// @param reachPx [px] > 0, the largest distance to consider.
/// @return nothing where there are no such strokes, or when cancelled. Same result with any number of threads.
std::optional<OverdrawnStrokes> findOverdrawnStrokes(const std::vector<Contour>& lines, double reachPx,
                                                     const RunContext& context);

}  // namespace batten
