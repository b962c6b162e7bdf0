// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/blots.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/image/bits/bit_disc.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/page_margins.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

constexpr int kExplainedDiscsPerLook = 256;  // between two looks at the cancel token

// What lines with their widths cover, and `reach(half width)` px around them.
template <class Reach>
BitImage coveredBy(const ContourSet& lines, const BitImage& like, const Reach& reach, const RunContext& context) {
  BitImage cover(like.width, like.height);
  int painted = 0;
  for (const Contour& line : lines.contours) {
    for (const ContourPoint& p : line.points) {
      if (painted++ % kExplainedDiscsPerLook == 0 && context.isCancelled()) return cover;
      const double half = 0.5 * static_cast<double>(p.widthPx.value_or(0.0f));
      setDisc(cover, p.at, half + reach(half));
    }
  }
  return cover;
}

}  // namespace

BitImage findBlots(const InkSplit& split, const ContourSet& lines, double minWidths, const RunContext& context) {
  constexpr double kBlotWidths = 3.0;  // [stroke widths] shorter ink has no direction
  constexpr double kBesideLinePx = 1.5;
  const RunPieces pieces = findPieces(split.strokes, Connectivity::Eight, context);
  BitImage rest(split.strokes.width, split.strokes.height);
  BitImage beside(split.strokes.width, split.strokes.height);
  for (const Contour& line : lines.contours) {
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      for (const Vec2& place : inkBeside(line, i)) setDisc(beside, place, kBesideLinePx);
    }
  }
  std::vector<bool> hasLine(pieces.runs.size(), false);
  std::vector<Run> box(pieces.runs.size());  // x0..x1 of each piece, y its last row
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const Run& run = pieces.runs[i];
    if (countBits(beside, run) > 0 || (split.pencil.width > 0 && countBits(split.pencil, run) > 0))
      hasLine[pieces.piece[i]] = true;
    Run& b = box[pieces.piece[i]];
    b = pieces.piece[i] == static_cast<int>(i) ? run : Run{run.y, std::min(b.x0, run.x0), std::max(b.x1, run.x1)};
    const double size = std::hypot(b.x1 - b.x0, b.y - pieces.runs[pieces.piece[i]].y + 1.0);
    if (minWidths > kBlotWidths && size > kBlotWidths * split.penPx) hasLine[pieces.piece[i]] = true;
  }
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    if (!hasLine[pieces.piece[i]]) setBits(rest, pieces.runs[i]);
  }
  return rest;
}

BitImage findFillings(const InkSplit& split, const ContourSet& lines, const RunContext& context) {
  constexpr double kWiderThanPen = 1.5;      // two strokes that cross at a right angle hold a disc of 1.41
  constexpr double kExplainedReachPx = 2.0;  // a line lies no farther from the ink that it explains, or half its width
  constexpr double kLeastArea = 3.0;         // [squared pen widths] a dot of two pens across
  constexpr double kBodyWidths = 2.5;        // strokes that cross at any angle hold no larger disc, and a pixel
  BitImage none(split.strokes.width, split.strokes.height);
  if (split.penPx <= 0.0 || split.strokes.count() == 0) return none;
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * kWiderThanPen * split.penPx)));
  BitImage wide = shrunken(split.strokes, half, context);
  if (split.pencil.width > 0) wide = without(std::move(wide), split.pencil);
  if (wide.count() == 0 || context.isCancelled()) return none;
  wide = without(std::move(wide), coveredBy(
                                      lines, wide, [&](double r) { return std::max(kExplainedReachPx, r); }, context));
  if (wide.count() == 0 || context.isCancelled()) return none;
  const BitImage strokes = coveredBy(
      lines, wide, [](double) { return 0.0; }, context);
  BitImage fillings = without(both(grown(wide, half + 1, context), split.strokes), strokes);
  if (context.isCancelled()) return none;
  const int body = std::max(half, static_cast<int>(std::floor(0.5 * (kBodyWidths * split.penPx + 1.0))));
  const BitImage bodies = grown(shrunken(split.strokes, body, context), body + 1, context);
  if (context.isCancelled()) return none;
  const int leastArea = static_cast<int>(std::lround(kLeastArea * split.penPx * split.penPx));
  return withoutMargins(keepPieces(fillings, {.minArea = leastArea, .seeds = &bodies}, context), context);
}

}  // namespace batten
