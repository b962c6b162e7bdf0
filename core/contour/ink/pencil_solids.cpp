// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/pencil_solids.h"

#include <algorithm>

#include "core/contour/centreline/stroke_mask.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

// All in stroke widths.
constexpr double kSolidWidths = 5.0;   // strokes side by side that have run together are narrower
constexpr double kBorderWidths = 3.0;  // what hangs on to a solid and is narrower is a stroke or a taper
constexpr double kStepAtSolid = 1.5;   // of widths, where a stroke leaves a solid; with less it is a taper
constexpr double kTaperWidths = kBorderWidths / kStepAtSolid;
// Of a solid: a filled shape has corners, a stroke that swells goes on.
constexpr double kMostTaper = 0.5;

BitImage opened(const BitImage& ink, double px, const RunContext& context) {
  const int steps = std::max(1, static_cast<int>(0.5 * px));
  return grown(shrunken(ink, steps, context), steps, context);
}

}  // namespace

BitImage pencilSolids(const BitImage& body, const BitImage& shapes, double penPx, const RunContext& context) {
  const BitImage seeds = opened(shapes, kSolidWidths * penPx, context);
  BitImage solids = keepPieces(opened(shapes, kBorderWidths * penPx, context), {.seeds = &seeds}, context);
  if (context.isCancelled() || solids.count() == 0) return solids;
  // Crescents between the openings are corners of a solid that the larger disc rounds.
  const BitImage beyond = without(opened(body, kTaperWidths * penPx, context), solids);
  const BitImage deep = shrunken(beyond, std::max(1, static_cast<int>(0.5 * kStepAtSolid * penPx)), context);
  const BitImage tapers = keepPieces(beyond, {.seeds = &deep}, context);
  const BitImage beside = grown(solids, 1, context);
  const BitImage whole = either(solids, keepPieces(tapers, {.seeds = &beside}, context));
  if (context.isCancelled()) return solids;
  return mostlyInk(whole, solids, 1.0 / (1.0 + kMostTaper), context);
}

}  // namespace batten
