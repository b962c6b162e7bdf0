// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/piece_line.h"

namespace batten {

std::vector<PiecePoint> piecePoints(std::span<const Vec2> positions) {
  std::vector<PiecePoint> points;
  points.reserve(positions.size());
  for (const Vec2& at : positions) points.push_back({.at = at});
  return points;
}

std::vector<Vec2> positionsOf(std::span<const PiecePoint> points) {
  std::vector<Vec2> at;
  at.reserve(points.size());
  for (const PiecePoint& p : points) at.push_back(p.at);
  return at;
}

}  // namespace batten
