// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// A point of a piece. What was not measured is absent; along one piece it is present at every point or at none.
struct PiecePoint {
  Vec2 at = Vec2::Zero();              ///< [px] image frame or [mm] model frame: that of the line it belongs to.
  bool refined = true;                 ///< Placed on the grey values; of what was drawn: drawn, not laid between.
  std::optional<float> sigmaPx = {};   ///< [px] > 0: standard deviation across the line.
  std::optional<float> spreadPx = {};  ///< [px] half-width of the bundle of merged strokes: the intended line may lie
                                       ///< anywhere within.
  std::optional<float> widthPx = {};   ///< [px] of the stroke that the line is the centre of.
};

/// The line of a piece: ordered points, about one a pixel of the scan.
struct PieceLine {
  std::vector<PiecePoint> points;  ///< Where an end is a corner, the first or last point is exactly the corner.
  bool closed = false;             ///< Smooth closed: periodic, no start and no end.
  bool startIsCorner = false;
  bool endIsCorner = false;
};

/// Points of which nothing but the position is known.
std::vector<PiecePoint> piecePoints(std::span<const Vec2> positions);
/// Copies of the positions, for the functions of core/polyline.
std::vector<Vec2> positionsOf(std::span<const PiecePoint>);
/// The line in another frame: every position by `change`, all else as it is.
template <typename Change>
PieceLine inFrame(PieceLine line, const Change& change) {
  for (PiecePoint& p : line.points) p.at = change(p.at);
  return line;
}

}  // namespace batten
