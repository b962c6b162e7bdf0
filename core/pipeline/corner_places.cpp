// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/corner_places.h"

#include "core/construct/fair_turns.h"

namespace batten {

std::vector<CornerSuggestion> suggestCornersAndCuts(const ContourSet& set, double minAngleRad, double scalePx) {
  std::vector<SharpTurn> turns;
  for (std::size_t c = 0; c < set.contours.size(); ++c) {
    const Contour& contour = set.contours[c];
    ConstructPiece piece;
    piece.points = contour.points;
    piece.closed = contour.closed;
    for (const PointRange& range : sharpTurns(piece, contour.kind == ContourKind::Centreline, 1.0, {})) {
      turns.push_back({static_cast<int>(c), range.first, range.last});
    }
  }
  return suggestCorners(set, minAngleRad, scalePx, turns);
}

}  // namespace batten
