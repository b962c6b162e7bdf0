// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/blots.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/contour/centreline/pencil/grain_closing.h"
#include "core/contour/chosen_ink.h"
#include "core/contour/ink/ribbons.h"
#include "core/image/bits/bit_disc.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/mark_rows.h"
#include "core/image/bits/page_margins.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

constexpr double kInkShare = 0.8;            // of a mark or a solid with its grain closed
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

// [px] by which ink shrinks to nothing unless it is wider than its strokes.
int stepsOfWide(double penPx) {
  constexpr double kWiderThanPen = 1.5;  // two strokes that cross at a right angle hold a disc of 1.41
  return std::max(1, static_cast<int>(std::lround(0.5 * kWiderThanPen * penPx)));
}

// What a pencil drew along a middle, its grain closed.
BitImage pencilStrokes(const PencilInk& pencil, const BitImage& shapes) { return without(pencil.body, shapes); }

// Places of ink wider than its strokes that the lines with their widths leave out, up to the strokes.
BitImage leftBeside(const BitImage& ink, std::optional<double> penPx, const ContourSet& lines,
                    const RunContext& context) {
  constexpr double kExplainedReachPx = 2.0;  // a line lies no farther from the ink that it explains, or half its width
  BitImage none(ink.width, ink.height);
  if (!penPx || ink.count() == 0) return none;
  const int half = stepsOfWide(*penPx);
  BitImage wide = shrunken(ink, half, context);
  if (wide.count() == 0 || context.isCancelled()) return none;
  const BitImage explained = coveredBy(
      lines, wide, [&](double r) { return std::max(kExplainedReachPx, r); }, context);
  wide = without(std::move(wide), explained);
  if (wide.count() == 0 || context.isCancelled()) return none;
  const BitImage strokes = coveredBy(
      lines, wide, [](double) { return 0.0; }, context);
  if (context.isCancelled()) return none;
  return without(both(grown(wide, half + 1, context), ink), strokes);
}

// What strokes of a pen enclose and fill. What is left beside a line that swells is none.
BitImage penFillings(const BitImage& ink, const BitImage& shapes, const std::optional<BitImage>& swellings,
                     std::optional<double> penPx, const ContourSet& lines, const RunContext& context) {
  constexpr double kLeastArea = 3.0;   // [squared pen widths] a dot of two pens across
  constexpr double kBodyWidths = 2.5;  // strokes that cross at any angle hold no larger disc, and a pixel
  BitImage fillings = leftBeside(ink, penPx, lines, context);
  if (fillings.count() == 0 || !penPx) return fillings;
  if (swellings) fillings = without(std::move(fillings), *swellings);
  const int half = stepsOfWide(*penPx);
  const int body = std::max(half, static_cast<int>(std::floor(0.5 * (kBodyWidths * *penPx + 1.0))));
  const BitImage bodies = grown(shrunken(ink, body, context), body + 1, context);
  const int leastArea = static_cast<int>(std::lround(kLeastArea * *penPx * *penPx));
  fillings = keepPieces(fillings, {.minArea = leastArea, .seeds = &bodies}, context);
  if (context.isCancelled()) return fillings;
  return withoutMargins(fillingsOfRibbons(fillings, ink, shapes, lines, context), context);
}

}  // namespace

BitImage findRows(const InkSplit& split, double minWidths, const RunContext& context) {
  constexpr double kLongest = 1.5;  // times the shortest line: its box also holds its width
  const double longest = kLongest * (minWidths * split.penPx.value_or(0.0));
  const BitImage brief = without(split.strokes, keepPieces(split.strokes, {.minDiagonal = longest}, context));
  return marksInRows(brief, either(split.strokes, split.shapes), context);
}

BitImage findBlots(const InkSplit& split, const ContourSet& lines, const BitImage& rows, double minWidths,
                   const RunContext& context) {
  constexpr double kBlotWidths = 3.0;    // [stroke widths] shorter ink has no direction
  constexpr double kBesideLinePx = 1.5;  // the pixel of a place and its eight neighbours
  BitImage ink = split.strokes;
  std::optional<BitImage> grainy;
  if (split.pencil) {
    const BitImage body = pencilStrokes(*split.pencil, split.shapes);
    const BitImage wide = shrunken(body, stepsOfWide(split.pencil->widthPx), context);
    grainy = without(body, mostlyInk(keepPieces(body, {.seeds = &wide}, context), split.strokes, kInkShare, context));
    ink = either(std::move(ink), body);
  }
  const RunPieces pieces = findPieces(ink, Connectivity::Eight, context);
  BitImage rest(split.strokes.width, split.strokes.height);
  BitImage beside(split.strokes.width, split.strokes.height);
  for (const Contour& line : lines.contours) {
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      for (const Vec2& place : inkBeside(line, i)) setDisc(beside, place, kBesideLinePx);
    }
  }
  std::vector<bool> hasLine(pieces.runs.size(), false);
  std::vector<InkRun> box(pieces.runs.size());  // x0..x1 of each piece, y its last row
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const InkRun& run = pieces.runs[i];
    const bool isGrain = grainy && countBits(*grainy, run) > 0 && countBits(rows, run) == 0;
    if (countBits(beside, run) > 0 || isGrain) hasLine[pieces.piece[i]] = true;
    InkRun& b = box[pieces.piece[i]];
    b = pieces.piece[i] == static_cast<int>(i) ? run : InkRun{run.y, std::min(b.x0, run.x0), std::max(b.x1, run.x1)};
    const double size = std::hypot(b.x1 - b.x0, b.y - pieces.runs[pieces.piece[i]].y + 1.0);
    if (minWidths > kBlotWidths && size > kBlotWidths * split.penPx.value_or(0.0)) hasLine[pieces.piece[i]] = true;
  }
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    if (!hasLine[pieces.piece[i]]) setBits(rest, pieces.runs[i]);
  }
  return withoutMargins(std::move(rest), context);
}

BitImage findFillings(const InkSplit& split, const ContourSet& lines, const RunContext& context) {
  if (!split.pencil) return penFillings(split.strokes, split.shapes, split.swellings, split.penPx, lines, context);
  // Tones of a pencil have no border; solids have, which lies where the strokes beside them do.
  const BitImage besideSolid = grown(split.shapes, 1, context);
  BitImage tones =
      mostlyInk(leftBeside(pencilStrokes(*split.pencil, split.shapes), split.pencil->widthPx, lines, context),
                split.strokes, kInkShare, context);
  tones = withoutMargins(keepPieces(tones, {.seeds = &besideSolid}, context), context);
  return either(penFillings(without(split.strokes, split.pencil->ink), split.shapes, split.swellings, split.penPx,
                            lines, context),
                tones);
}

BitImage chosenOf(const BitImage& blots, const RunPieces& regions, const EdgeParams& edges) {
  BitImage chosenBlots(blots.width, blots.height);
  const ChosenInk chosen(regions, edges.choices);
  for (std::size_t i = 0; i < regions.runs.size(); ++i) {
    if (chosen.choiceOf(regions.piece[i])) copyBits(blots, regions.runs[i], chosenBlots);
  }
  return chosenBlots;
}

BitImage notChosen(BitImage fillings, const RunPieces& regions, const std::optional<BitImage>& painted,
                   const EdgeParams& edges) {
  if (painted) fillings = without(std::move(fillings), *painted);
  const ChosenInk chosen(regions, edges.choices);
  for (std::size_t i = 0; i < regions.runs.size(); ++i) {
    if (chosen.choiceOf(regions.piece[i])) clearBits(fillings, regions.runs[i]);
  }
  return fillings;
}

}  // namespace batten
