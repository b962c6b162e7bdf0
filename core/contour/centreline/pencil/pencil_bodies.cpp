// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/pencil/pencil_bodies.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/contour/centreline/pencil/grain_closing.h"
#include "core/contour/centreline/pencil/oriented_line_filter.h"
#include "core/image/bits/bit_disc.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

// Covers the strokes that were, or were not, drawn with a pencil, and `margin` px around them.
BitImage coverOf(const BitImage& like, const std::vector<StrokePath>& paths, const GraininessMap& grain, bool pencil,
                 double margin, const RunContext& context) {
  constexpr int kDiscsPerLook = 64;        // between two looks at the cancel token
  constexpr double kDiscsPerRadius = 6.0;  // discs nearer to each other cover nothing new
  BitImage cover(like.width, like.height);
  for (int i = 0; i < std::ssize(paths); ++i) {
    if (grain.isPencil(i) != pencil) continue;
    const std::vector<StrokePathPoint>& points = paths[i].points;
    const int n = static_cast<int>(points.size());
    int painted = 0;
    for (int k = 0; k < n;) {
      if (painted++ % kDiscsPerLook == 0 && context.isCancelled()) return cover;
      const double radius = static_cast<double>(points[k].radius) + margin;
      setDisc(cover, points[k].at, radius);
      // The last one is always painted.
      k = k + 1 < n ? std::min(k + static_cast<int>(std::max(1.0, radius / kDiscsPerRadius)), n - 1) : n;
    }
  }
  return cover;
}

// Of what was taken out of bodies, the holes of their grain: ink that the rest encloses, and shorter than paper between
// two lines runs. What was paper before the bodies were closed is the inside of a loop.
BitImage grainHoles(const BitImage& taken, const BitImage& rest, const BitImage& strokes, double widthPx,
                    const RunContext& context) {
  constexpr double kLeastInkShare = 0.25;  // of a hole of grain; that of a loop has none but at its rim
  // The means that tell lines from paper are as long: half of it at either side.
  constexpr double kLeastGapWidths = 4.0;
  const BitImage body = either(taken, rest);
  const BitImage brief = without(taken, keepPieces(taken, {.minDiagonal = kLeastGapWidths * widthPx}, context));
  const BitImage besidePaper = grown(without(grown(body, 1, context), body), 1, context);
  const BitImage enclosed = without(brief, keepPieces(brief, {.seeds = &besidePaper}, context));
  return mostlyInk(enclosed, strokes, kLeastInkShare, context);
}

}  // namespace

BitImage pencilBodies(const BitImage& strokes, const GreyImage& grey, const std::vector<StrokePath>& paths,
                      const GraininessMap& grain, const PencilBodyOptions& options, const RunContext& context) {
  const double width = medianWidth(paths, [&](int i) { return grain.isPencil(i); });
  const double closing = grainClosing(width);
  BitImage body = closeGrain(strokes, width, options.pixelsPerPx > 1, context);
  if (options.clear != nullptr) body = without(std::move(body), *options.clear);
  bool anyPen = false;
  for (int i = 0; i < std::ssize(paths); ++i) anyPen = anyPen || !grain.isPencil(i);
  BitImage ownPens(strokes.width, strokes.height);
  if (anyPen) {
    ownPens = without(coverOf(strokes, paths, grain, false, closing, context),
                      coverOf(strokes, paths, grain, true, closing, context));
    body = either(without(std::move(body), ownPens), strokes);
  }
  if (context.isCancelled()) return strokes;
  const OrientedLines found =
      filterOrientedLines(without(body, ownPens), grey, grain, width, context, options.pixelsPerPx);
  const BitImage carved = either(without(body, found.gaps), without(found.lines, ownPens));
  return either(carved, grainHoles(without(std::move(body), carved), carved, strokes, width, context));
}

}  // namespace batten
