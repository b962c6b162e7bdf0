// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/pencil_solids.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

// All in stroke widths.
constexpr double kSolidWidths = 5.0;   // strokes side by side that have run together are narrower
constexpr double kBorderWidths = 3.0;  // what hangs on to a solid and is narrower is a stroke or a taper
constexpr double kStep = 1.5;          // of widths, where a stroke leaves a solid; with less it is a taper
constexpr double kTaperWidths = kBorderWidths / kStep;

BitImage opened(const BitImage& ink, double px, const RunContext& context) {
  const int steps = std::max(1, static_cast<int>(0.5 * px));
  return grown(shrunken(ink, steps, context), steps, context);
}

// The pieces of `whole` of whose area in `solids` their tapers are not too large a part.
BitImage mostlySolid(const BitImage& whole, const BitImage& solids, const RunContext& context) {
  constexpr double kMostTaper = 0.5;  // of its solid: a filled shape has corners, a stroke that swells goes on
  const RunPieces pieces = findPieces(whole, Connectivity::Eight, context);
  std::vector<std::int64_t> area(pieces.runs.size()), solid(pieces.runs.size());
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    area[pieces.piece[i]] += pieces.runs[i].x1 - pieces.runs[i].x0;
    solid[pieces.piece[i]] += countBits(solids, pieces.runs[i]);
  }
  BitImage kept(whole.width, whole.height);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const int piece = pieces.piece[i];
    if (static_cast<double>(area[piece]) <= (1.0 + kMostTaper) * static_cast<double>(solid[piece]))
      setBits(kept, pieces.runs[i]);
  }
  return kept;
}

}  // namespace

BitImage pencilSolids(const BitImage& body, const BitImage& shapes, double penPx, const RunContext& context) {
  const BitImage seeds = opened(shapes, kSolidWidths * penPx, context);
  BitImage solids = keepPieces(opened(shapes, kBorderWidths * penPx, context), {.seeds = &seeds}, context);
  if (context.isCancelled() || solids.count() == 0) return solids;
  // Crescents between the openings are corners of a solid that the larger disc rounds.
  const BitImage beyond = without(opened(body, kTaperWidths * penPx, context), solids);
  const BitImage deep = shrunken(beyond, std::max(1, static_cast<int>(0.5 * kStep * penPx)), context);
  const BitImage tapers = keepPieces(beyond, {.seeds = &deep}, context);
  const BitImage beside = grown(solids, 1, context);
  const BitImage whole = either(solids, keepPieces(tapers, {.seeds = &beside}, context));
  if (context.isCancelled()) return solids;
  return mostlySolid(whole, solids, context);
}

}  // namespace batten
