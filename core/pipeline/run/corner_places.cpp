// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/corner_places.h"

#include "core/construct/fair/sharp_features.h"
#include "core/contour/corner/corner_suggestions.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSmallLoopPx = 70.0;  // round: radius 11 px

}  // namespace

std::vector<CornerSuggestion> suggestCornersAndCuts(const ContourSet& set, double minAngleRad, double scalePx,
                                                    const RunContext& context) {
  std::vector<SharpTurn> turns;
  for (int c = 0; c < std::ssize(set.contours) && !context.isCancelled(); ++c) {
    const Contour& contour = set.contours[c];
    ConstructPiece piece;
    piece.points = positionsOf(contour.points);
    // What is as small as this and round is as sharp as a cut all over.
    if (contour.closed && polylineLength(piece.points, true) < kSmallLoopPx) continue;
    piece.closed = contour.closed;
    for (const PointRange& range : sharpTurns(piece, contour.kind == ContourKind::Centreline, 1.0, {})) {
      turns.push_back({c, range.first, range.last});
    }
  }
  return suggestCorners(set, minAngleRad, scalePx, context, turns);
}

}  // namespace batten
