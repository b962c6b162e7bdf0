// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"

namespace batten {

/// How two lines that run side by side cease to do so.
enum class SideEnd {
  Meets,      ///< They come together at a small angle, and ink goes on from there: one crosses or joins the other.
  Tip,        ///< They come together where both end, like the tip of a leaf, or are one line that turns back.
  OwnEnd,     ///< The line itself ends there, touching nothing; the other goes on.
  OtherEnd,   ///< The other one does.
  LevelEnds,  ///< Both end at about the same place, as the strokes of a hatching do.
  Cut,        ///< One of them ends on another line.
  Between,    ///< A third line comes between them.
  Parts,      ///< They part, though both go on.
  Never,      ///< Rings that run round beside each other.
};

/// A stretch of a line beside which, on one side, the same or another line runs within reach in about its direction.
/// Every such pair is seen twice, once from either line.
struct ParallelStretch {
  int line = 0;  ///< Of the lines given.
  SideEnd begin = SideEnd::Never, end = SideEnd::Never;
  double stepPx = 1.0;          ///< Between the places where it was measured.
  int firstStep = 0;            ///< Where it begins, in steps from the line's start; on a ring it may run past that.
  std::vector<double> apartPx;  ///< Between the middles, there.
  double widestPx = 0.0;        ///< Of `apartPx`.
  double lengthPx() const { return stepPx * static_cast<double>(apartPx.size()); }
};

/// [px] As near as this the middles of two lines touch, for a pen of this width.
inline double touchingPx(double widthPx) { return 2.0 * widthPx; }

/// All stretches of the lines beside which the nearest line of about the same direction lies no farther than
/// `reachPx`. In the order of the lines. Not complete when cancelled. Same result with any number of threads.
/// @param widthPx [px] > 0, of the pen.
std::vector<ParallelStretch> findParallelStrokes(const std::vector<Contour>& lines, double widthPx, double reachPx,
                                                 const RunContext& context);

}  // namespace batten
