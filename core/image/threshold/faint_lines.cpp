// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/faint_lines.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

constexpr int kSoftSidePx = 3;  ///< [px] From the deep part of a stroke to where its blurred side ends.
constexpr int kFewestThinSteps = 3, kMostThinSteps = 5;  ///< [px] Half the width from which a faint place is no line.
constexpr double kMinLengthPx = 40.0;                    ///< [px] Of a line that stands alone.
constexpr double kMinJoinedPx = 12.0;                    ///< [px] Of a line that continues ink.
constexpr double kLengthPerWidth = 7.0;                  // of a line that stands alone: a shorter one is a spot
constexpr double kJoinedPerWidth = 3.0;                  // of a line that continues ink
constexpr double kBoxPerArea = 5.0;     ///< Squared diagonal of the box per area: texture fills its box.
constexpr double kMostAtWide = 0.25;    ///< Share of a piece that may lie where wide faint strokes are.
constexpr double kMostAlongside = 0.5;  ///< Share of a piece that may lie beside ink.

struct Piece {
  std::int64_t area = 0, interior = 0, beside = 0, atWide = 0;
  double diagonal = 0.0;  ///< [px] Of its box.

  bool isLine(int pixelsPerPx) const {
    // A long strip of width w has two border pixels for every w of its area.
    const double border = std::max(1.0, static_cast<double>(area - interior));
    const double length = 0.5 * border, width = static_cast<double>(area) / length;
    if (static_cast<double>(atWide) > kMostAtWide * static_cast<double>(area)) return false;
    if (static_cast<double>(beside) > kMostAlongside * static_cast<double>(area)) return false;
    if (diagonal * diagonal < kBoxPerArea * static_cast<double>(area) && beside == 0) return false;
    if (beside > 0) return diagonal >= kMinJoinedPx * pixelsPerPx && length >= kJoinedPerWidth * width;
    return diagonal >= kMinLengthPx * pixelsPerPx && length >= kLengthPerWidth * width;
  }
};

std::vector<Piece> measure(const RunPieces& found, const BitImage& interior, const BitImage& beside,
                           const BitImage& wide) {
  const std::vector<std::int64_t> areas = areasOfPieces(found);
  const std::vector<PieceBox> boxes = boxesOfPieces(found);
  std::vector<Piece> pieces(found.runs.size());
  for (std::size_t i = 0; i < found.runs.size(); ++i) {
    pieces[i].area = areas[i];
    pieces[i].diagonal = boxes[i].diagonal();
    const InkRun& run = found.runs[i];
    Piece& piece = pieces[found.piece[i]];
    piece.interior += countBits(interior, run);
    piece.beside += countBits(beside, run);
    piece.atWide += countBits(wide, run);
  }
  return pieces;
}

/// Where the faint places are wider than the drawing's own strokes, with all that hangs on to them. Noise tears holes
/// into weak strokes, hence they are closed first.
BitImage widePlaces(const FaintMasks& masks, int pixelsPerPx, const RunContext& context) {
  const std::int64_t area = masks.ink.count();
  const std::int64_t border = std::max<std::int64_t>(1, area - shrunken(masks.ink, 1, context).count());
  const double strokePx = 2.0 * static_cast<double>(area) / static_cast<double>(border);
  const int steps = std::clamp(static_cast<int>(std::lround(0.5 * strokePx)), pixelsPerPx * kFewestThinSteps,
                               pixelsPerPx * kMostThinSteps);
  const BitImage closed = grown(masks.faint, 1, context);
  return grown(shrunken(closed, steps + 1, context), steps + 3, context);
}

}  // namespace

BitImage addFaintLines(const FaintMasks& masks, const RunContext& context, int pixelsPerPx) {
  const int softSidePx = pixelsPerPx * kSoftSidePx;
  const BitImage softSide = grown(both(masks.certain, masks.ink), softSidePx, context);
  const BitImage open = without(masks.faint, softSide);
  if (context.isCancelled() || open.count() == 0) return masks.ink;
  const BitImage wide = widePlaces(masks, pixelsPerPx, context);
  const BitImage beside = grown(softSide, 2, context);
  const BitImage interior = shrunken(open, 1, context);
  const RunPieces found = findPieces(open, Connectivity::Eight, context);
  if (context.isCancelled()) return masks.ink;
  const std::vector<Piece> pieces = measure(found, interior, beside, wide);
  BitImage lines(open.width, open.height);
  for (std::size_t i = 0; i < found.runs.size(); ++i) {
    if (pieces[found.piece[i]].isLine(pixelsPerPx)) setBits(lines, found.runs[i]);
  }
  // The soft side was left out: where a line runs into ink, it is let through.
  return either(either(masks.ink, lines), both(grown(lines, softSidePx, context), masks.faint));
}

}  // namespace batten
