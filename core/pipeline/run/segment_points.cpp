// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/segment_points.h"

#include <algorithm>
#include <limits>

#include "core/pipeline/run/curve_stages.h"

namespace batten {

std::vector<std::vector<std::size_t>> assignSegmentPoints(const PieceSet& pieces, const Recipe& recipe) {
  std::vector<std::vector<std::size_t>> assigned(pieces.pieces.size());
  for (std::size_t i = 0; i < recipe.segmentPoints.size(); ++i) {
    const Vec2& place = recipe.segmentPoints[i].positionPx;
    std::size_t owner = pieces.pieces.size();
    double nearest = recipe.corners.snapDistancePx * recipe.corners.snapDistancePx;
    for (std::size_t k = 0; k < pieces.pieces.size(); ++k) {
      for (const PiecePoint& p : pieces.pieces[k].points) {
        const double away = (p.at - place).squaredNorm();
        if (away >= nearest) continue;
        nearest = away;
        owner = k;
      }
    }
    if (owner < assigned.size()) assigned[owner].push_back(i);
  }
  return assigned;
}

Result<std::vector<GrowingStep>> growingStepsOf(const PieceSet& pieces, const SegmentSet& segments,
                                                const Recipe& recipe, const PageFrame& frame, int piece,
                                                const RunContext& context) {
  if (piece < 0 || piece >= std::ssize(pieces.pieces) || segments.pieces.size() != pieces.pieces.size()) {
    return fail(ErrorCode::Numerical, "This curve no longer exists.");
  }
  Recipe grown = recipe;
  grown.construct.method = ConstructMethod::Typical;
  grown.construct.typical = TypicalMode::Growing;
  return growingSteps(typicalPieceOf(pieces, segments, grown, frame, piece), frame.mmPerPx, grown.construct, context);
}

}  // namespace batten
