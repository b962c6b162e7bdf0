// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/pencil_solids.h"

#include <algorithm>
#include <cmath>

#include "core/contour/centreline/pencil/grain_closing.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

// All in stroke widths.
constexpr double kSolidWidths = 5.0;   // strokes side by side that have run together are narrower
constexpr double kBorderWidths = 3.0;  // what hangs on to a solid and is narrower is a stroke or a taper
constexpr double kStepAtSolid = 1.5;   // of widths, where a stroke leaves a solid; with less it is a taper
constexpr double kSolidTaperWidths = kBorderWidths / kStepAtSolid;
// Of a solid: a filled shape has corners, a stroke that swells goes on.
constexpr double kMostTaper = 0.5;
constexpr double kCertainWidths = 9.0;  // no stroke swells to this
// Of half the disc that opens a solid: how far its corners reach beyond the octagon, and how thick a limb in one is.
constexpr double kCornerReach = 0.75, kCornerLimb = 0.4;

BitImage opened(const BitImage& ink, double px, const RunContext& context) {
  const int steps = std::max(1, static_cast<int>(0.5 * px));
  return grown(shrunken(ink, steps, context), steps, context);
}

// Solids with their corners, which the disc that opened them cuts off. What goes on beyond a corner is a stroke.
BitImage withCorners(BitImage solids, const BitImage& body, double openedPx, const RunContext& context) {
  const int reach = static_cast<int>(std::ceil(kCornerReach * 0.5 * openedPx));
  const BitImage thick = opened(body, kCornerLimb * openedPx, context);
  const BitImage around = grown(solids, reach, context);
  const BitImage corners = without(both(around, thick), solids);
  const BitImage onwards = grown(without(BitImage(thick), around), 1, context);
  const BitImage ofStrokes = keepPieces(corners, {.seeds = &onwards}, context);
  if (context.isCancelled()) return solids;
  return either(std::move(solids), without(BitImage(corners), ofStrokes));
}

// What is taper for the most part is no solid but a stroke that swells.
BitImage withTapers(const BitImage& solids, const BitImage& body, double penPx, const RunContext& context) {
  // Crescents between the openings are corners of a solid that the larger disc rounds.
  const BitImage beyond = without(opened(body, kSolidTaperWidths * penPx, context), solids);
  const BitImage deep = shrunken(beyond, std::max(1, static_cast<int>(0.5 * kStepAtSolid * penPx)), context);
  const BitImage tapers = keepPieces(beyond, {.seeds = &deep}, context);
  const BitImage beside = grown(solids, 1, context);
  const BitImage whole = either(BitImage(solids), keepPieces(tapers, {.seeds = &beside}, context));
  if (context.isCancelled()) return solids;
  return mostlyInk(whole, solids, 1.0 / (1.0 + kMostTaper), context);
}

}  // namespace

BitImage pencilSolids(const BitImage& body, const BitImage& shapes, double penPx, const RunContext& context) {
  const BitImage seeds = opened(shapes, kSolidWidths * penPx, context);
  BitImage solids = keepPieces(opened(shapes, kBorderWidths * penPx, context), {.seeds = &seeds}, context);
  if (context.isCancelled() || solids.count() == 0) return solids;
  const BitImage largest = opened(solids, kCertainWidths * penPx, context);
  const BitImage certain = keepPieces(solids, {.seeds = &largest}, context);
  const BitImage doubtful = without(BitImage(solids), certain);
  BitImage whole = either(BitImage(certain), withTapers(doubtful, without(BitImage(body), certain), penPx, context));
  return withCorners(std::move(whole), body, kBorderWidths * penPx, context);
}

}  // namespace batten
