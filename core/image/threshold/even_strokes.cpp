// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/even_strokes.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/statistics.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

constexpr int kBesideInkPx = 3;       // [px] the blurred side of ink that is there already
constexpr int kBlurredPx = 2;         // [px] from the border of a stroke to where its grey is its own
constexpr double kLeastInside = 0.3;  // of the area: thinner strokes are found as lines
constexpr double kLeastLengthPx = 40.0, kEvenLengthPerWidth = 7.0;  // shorter pieces are spots
constexpr double kEvenBoxPerArea = 3.0;  // squared diagonal of the box per area: a streaky fill fills its box
constexpr double kWidestEven = 0.03;     // of the page's mean side: 7 mm on A4; what is wider is a tone or a shadow
constexpr double kMostBesideInk = 0.25;  // of its border: an area that lines bound is a tone
constexpr double kLeastOfInk = 0.25;     // of the depth of ink: fainter hatching is shading
constexpr double kEvenSpread = 0.15;     // of its depth: standard deviation of the grey inside
constexpr int kSampleStridePx = 3;       // [px] along a row

// One piece, with its greys below the paper where it is not blurred.
struct PalePiece {
  std::int64_t areaPx = 0, insidePx = 0, borderPx = 0, besideInkPx = 0;
  bool leavesPicture = false;
  std::vector<float> depths;

  bool isLong(double diagonalPx, double widestPx, double leastPx) const {
    // A long strip of width w has two border pixels for every w of its area.
    const auto area = static_cast<double>(areaPx);
    const double length = 0.5 * static_cast<double>(borderPx);
    return diagonalPx >= leastPx && length * length >= kEvenLengthPerWidth * area && area <= widestPx * length &&
           diagonalPx * diagonalPx >= kEvenBoxPerArea * area &&
           static_cast<double>(besideInkPx) <= kMostBesideInk * static_cast<double>(borderPx) &&
           static_cast<double>(insidePx) >= kLeastInside * area;
  }
  bool isEven(double leastDepth) {
    if (depths.empty()) return false;
    const float depth = upperMedian(depths);
    if (static_cast<double>(depth) < leastDepth) return false;
    for (float& d : depths) d -= depth;
    return robustSigma(depths) <= kEvenSpread * static_cast<double>(depth);
  }
};

void addDepths(const EvenStrokeSources& sources, const BitImage& inside, const InkRun& run, std::vector<float>& out) {
  // Another column in every row, so that no raster of the print is met in step.
  for (int x = run.x0 + run.y % kSampleStridePx; x < run.x1; x += kSampleStridePx) {
    if (!inside.at(x, run.y)) continue;
    const double paper = sources.paper.at(x + 0.5, run.y + 0.5);
    out.push_back(static_cast<float>(paper - sources.image.row(run.y)[x] / GreyImage::kGreyUnit));
  }
}

// The pieces of `open` that are strokes.
BitImage evenStrokes(const BitImage& open, const BitImage& inside, const BitImage& side,
                     const EvenStrokeSources& sources, const RunContext& context, int pixelsPerPx) {
  BitImage strokes(open.width, open.height);
  const BitImage border = without(open, shrunken(open, 1, context));
  const BitImage besideInk = both(border, grown(side, 2, context));
  const RunPieces found = findPieces(open, Connectivity::Eight, context);
  if (context.isCancelled()) return strokes;
  const std::vector<PieceBox> boxes = boxesOfPieces(found);
  std::vector<PalePiece> pieces(found.runs.size());
  for (std::size_t i = 0; i < found.runs.size(); ++i) {
    const InkRun& run = found.runs[i];
    PalePiece& piece = pieces[found.piece[i]];
    piece.areaPx += run.x1 - run.x0;
    piece.insidePx += countBits(inside, run);
    piece.borderPx += countBits(border, run);
    piece.besideInkPx += countBits(besideInk, run);
    piece.leavesPicture |= run.y == 0 || run.y == open.height - 1 || run.x0 == 0 || run.x1 == open.width;
  }
  const double widestPx = kWidestEven * std::sqrt(static_cast<double>(open.width) * open.height);
  std::vector<bool> isStroke(pieces.size(), false);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    isStroke[i] = pieces[i].areaPx > 0 && !pieces[i].leavesPicture &&
                  pieces[i].isLong(boxes[i].diagonal(), widestPx, kLeastLengthPx * pixelsPerPx);
  for (std::size_t i = 0; i < pieces.size() && !context.isCancelled(); ++i) {
    if (isStroke[found.piece[i]]) addDepths(sources, inside, found.runs[i], pieces[found.piece[i]].depths);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i)
    isStroke[i] = isStroke[i] && pieces[i].isEven(kLeastOfInk * sources.inkDepth);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (isStroke[found.piece[i]]) setBits(strokes, found.runs[i]);
  }
  return strokes;
}

}  // namespace

BitImage addEvenStrokes(BitImage ink, const EvenStrokeSources& sources, const RunContext& context, int pixelsPerPx) {
  const int sidePx = kBesideInkPx * pixelsPerPx;
  // Most pages hold nothing faint but the blurred sides of their ink, which vanish at once.
  if (shrunken(without(sources.faint, ink), kBlurredPx * pixelsPerPx, context).count() == 0) return ink;
  const BitImage side = grown(ink, sidePx, context);
  BitImage open = without(sources.faint, side);
  const BitImage inside = shrunken(open, kBlurredPx * pixelsPerPx, context);
  if (context.isCancelled() || inside.count() == 0) return ink;
  open = keepPieces(open, {.seeds = &inside}, context);
  if (context.isCancelled()) return ink;
  const BitImage strokes = evenStrokes(open, inside, side, sources, context, pixelsPerPx);
  if (context.isCancelled() || strokes.count() == 0) return ink;
  // The side of ink was left out: where a stroke runs into a line, it is let through.
  return either(either(std::move(ink), strokes), both(grown(strokes, sidePx, context), sources.faint));
}

}  // namespace batten
