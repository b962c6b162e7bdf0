// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/tonal_holes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/statistics.h"
#include "core/contour/subpixel/edge_profile.h"

namespace batten {
namespace {

// [pencil widths] to either side of a border: the middle of a stroke of the pencil, and the next gap of its hatching.
constexpr double kWithin = 0.5, kBeyondHole = 1.0;
constexpr double kAlongTones = 6.0;     // points: the grain along the border
constexpr double kFaint = 0.55;         // of the contrast of the outer borders: a highlight has less
constexpr double kNotBeyond = 0.4;      // of the contrast within a stroke: between the strokes is paper again
constexpr double kRaggedOutline = 5.0;  // length squared over 4 pi areas: a circle has 1, ends of hatching 6 to 30

/// [grey] The mean contrast along a border, and in so far as it lasts beyond the width of a stroke.
struct Contrast {
  double within = 0.0, beyond = 0.0;
};
Contrast contrastOf(const Contour& c, double pencilPx, const GreyImage& grey, const RunContext& context) {
  const std::vector<EdgeRise> rises = edgeRises(unrefinedPositionsOf(c.points), c.closed, grey,
                                                {kWithin * pencilPx, kBeyondHole * pencilPx}, kAlongTones, context);
  Contrast sum;
  const auto n = static_cast<double>(rises.size());
  for (const EdgeRise& rise : rises) {
    sum.within += static_cast<double>(rise.inner) / n;
    sum.beyond += static_cast<double>(rise.outer) / n;
  }
  return sum;
}

/// [grey] Of the outer borders of pencilled areas, in the middle, each as often as it is long. 0: there are none.
double usualContrast(const ContourSet& set, const GreyImage& grey, const RunContext& context) {
  constexpr std::size_t kPointsOfVote = 50;  // along a border, about 1 px apart
  std::vector<double> votes;
  for (const Contour& c : set.contours) {
    if (c.kind != ContourKind::Outline || c.hole || !c.pencilPx || context.isCancelled()) continue;
    const Contrast contrast = contrastOf(c, *c.pencilPx, grey, context);
    votes.insert(votes.end(), c.points.size() / kPointsOfVote + 1, contrast.within);
  }
  return votes.empty() ? 0.0 : upperMedian(votes);
}

bool isTonal(const Contour& c, double usual, const GreyImage& grey, const RunContext& context) {
  const Contrast contrast = contrastOf(c, *c.pencilPx, grey, context);
  if (contrast.within < kFaint * usual) return true;
  const double ragged = c.lengthPx * c.lengthPx / (4.0 * std::numbers::pi * std::max(1.0, c.areaPx));
  return ragged > kRaggedOutline && contrast.beyond < kNotBeyond * contrast.within;
}

}  // namespace

void dropTonalHoles(ContourSet& set, const GreyImage& grey, const RunContext& context) {
  const auto isPencilledHole = [](const Contour& c) { return c.hole && c.closed && c.pencilPx && !c.traceMode; };
  if (std::none_of(set.contours.begin(), set.contours.end(), isPencilledHole)) return;
  const double usual = usualContrast(set, grey, context);
  const auto dropped = std::erase_if(set.contours, [&](const Contour& c) {
    return isPencilledHole(c) && !context.isCancelled() && isTonal(c, usual, grey, context);
  });
  set.report.droppedHoles += static_cast<int>(dropped);
}

}  // namespace batten
