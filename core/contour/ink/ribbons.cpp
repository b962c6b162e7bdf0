// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/ribbons.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/base/statistics.h"
#include "core/contour/label/ink_graph.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/mask_distance.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

constexpr double kAroundWidths = 4.0;  // as far along a ribbon as makes it longer than wide to either side
constexpr double kRibbonStep = 1.5;    // of widths; ink that is narrower is another thing
// Of its area: what lines that run through it cover is the rest. A solid shares its ribbon with the lines around it.
constexpr double kMostOfRibbon = 0.5, kSolidOfRibbon = 0.25;

// A part of the page, and what of it a filling takes.
struct RibbonWindow {
  int x0, y0, x1, y1;
  BitImage cropped(const BitImage& image) const {
    BitImage part(x1 - x0, y1 - y0);
    for (int y = 0; y < part.height; ++y) {
      for (int i = 0; i < part.wordsPerRow; ++i) {
        const int first = x0 + 64 * i, word = first >> 6, shift = first & 63;
        std::uint64_t bits = image.row(y0 + y)[word] >> shift;
        if (shift != 0 && word + 1 < image.wordsPerRow) bits |= image.row(y0 + y)[word + 1] << (64 - shift);
        part.row(y)[i] = bits;
      }
      part.row(y)[part.wordsPerRow - 1] &= part.lastWordMask();
    }
    return part;
  }
};

struct Filling {
  std::vector<InkRun> runs;
  int x0 = 0, x1 = 0;    // [px] of its box; its rows are those of its runs
  double widthPx = 0.0;  // of its largest disc
  double inkPx = 0.0;    // of the largest disc of ink with its centre in it
  double linePx = 0.0;   // of the widest line beside it, where it is as wide as usual
  bool isBesideShape = false;
  // No two lines of those beside it hold such a disc where they cross or run side by side.
  bool isSolid() const { return linePx > 0.0 && widthPx > coreWidth(linePx); }
};

std::map<int, Filling> measuredFillings(const BitImage& fillings, const RunPieces& pieces, const BitImage& strokes,
                                        const BitImage& shapes, const RunContext& context) {
  const BitImage besideShapes = grown(shapes, 1, context);
  MaskDistance inInk(strokes), inFilling(fillings);
  const auto disc = [](MaskDistance& distance, int x, int y) {
    return 2.0 * std::sqrt(static_cast<double>(distance.squared(x, y)));
  };
  std::map<int, Filling> byPiece;
  for (std::size_t i = 0; i < pieces.runs.size() && !context.isCancelled(); ++i) {
    const InkRun& run = pieces.runs[i];
    Filling& filling = byPiece[pieces.piece[i]];
    filling.x0 = filling.runs.empty() ? run.x0 : std::min(filling.x0, run.x0);
    filling.x1 = std::max(filling.x1, run.x1);
    filling.runs.push_back(run);
    filling.isBesideShape = filling.isBesideShape || countBits(besideShapes, run) > 0;
    for (int x = run.x0; x < run.x1; ++x) {
      filling.widthPx = std::max(filling.widthPx, disc(inFilling, x, run.y));
      filling.inkPx = std::max(filling.inkPx, disc(inInk, x, run.y));
    }
  }
  return byPiece;
}

void noteLinesBeside(std::map<int, Filling>& byPiece, const RunPieces& pieces, const ContourSet& lines) {
  constexpr double kBesidePx = 1.5;  // beyond the edge of a line, across a diagonal neighbour
  for (const Contour& line : lines.contours) {
    std::vector<float> widths = strokeWidthsOf(line.points);
    if (widths.empty()) continue;
    const double usual = static_cast<double>(upperMedian(widths));  // where it runs through a solid it is none's
    for (const ContourPoint& p : line.points) {
      if (!p.widthPx) continue;
      const double reach = 0.5 * static_cast<double>(*p.widthPx) + kBesidePx;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
        const Vec2 at = p.at + reach * Vec2(dx, dy).normalized();
        const auto piece = pieceAt(pieces, static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
        if (piece) byPiece[*piece].linePx = std::max(byPiece[*piece].linePx, usual);
      }
    }
  }
}

bool isMostOfItsRibbon(const Filling& filling, const BitImage& fillings, const BitImage& strokes,
                       const RunContext& context) {
  const int reach = static_cast<int>(std::ceil(kAroundWidths * filling.inkPx));
  const RibbonWindow window{std::max(0, filling.x0 - reach), std::max(0, filling.runs.front().y - reach),
                            std::min(strokes.width, filling.x1 + reach),
                            std::min(strokes.height, filling.runs.back().y + 1 + reach)};
  BitImage own(window.x1 - window.x0, window.y1 - window.y0);
  for (const InkRun& run : filling.runs) setBits(own, {run.y - window.y0, run.x0 - window.x0, run.x1 - window.x0});
  const int steps = static_cast<int>(0.5 * filling.inkPx / kRibbonStep);
  const BitImage ink = window.cropped(strokes);
  const BitImage wide = both(grown(shrunken(ink, steps, context), steps, context), ink);
  const BitImage ribbon = keepPieces(wide, {.seeds = &own}, context);
  const auto filled = static_cast<double>(both(window.cropped(fillings), ribbon).count());
  const double least = filling.isSolid() ? kSolidOfRibbon : kMostOfRibbon;
  return filled >= least * static_cast<double>(ribbon.count());
}

}  // namespace

BitImage fillingsOfRibbons(const BitImage& fillings, const BitImage& strokes, const BitImage& shapes,
                           const ContourSet& lines, const RunContext& context) {
  const RunPieces pieces = findPieces(fillings, Connectivity::Eight, context);
  if (context.isCancelled() || pieces.runs.empty()) return fillings;
  std::map<int, Filling> byPiece = measuredFillings(fillings, pieces, strokes, shapes, context);
  noteLinesBeside(byPiece, pieces, lines);
  BitImage kept = fillings;
  for (const auto& [number, filling] : byPiece) {
    if (context.isCancelled()) return fillings;
    if (filling.isBesideShape || isMostOfItsRibbon(filling, fillings, strokes, context)) continue;
    for (const InkRun& run : filling.runs) clearBits(kept, run);
  }
  return kept;
}

}  // namespace batten
