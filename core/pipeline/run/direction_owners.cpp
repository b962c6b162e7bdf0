// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/direction_owners.h"

#include <algorithm>

namespace batten {
namespace {

constexpr double kMarkReachPx = 24.0;  // from a mark to the line that it means
/// [points] Over so many to both sides of a place the direction of a line is taken.
constexpr std::ptrdiff_t kChordPoints = 4;

struct PlaceOnPiece {
  std::size_t piece = 0;
  std::ptrdiff_t point = 0;
};

std::optional<PlaceOnPiece> placeNear(const PieceSet& set, const Vec2& px) {
  std::optional<PlaceOnPiece> found;
  double nearest = kMarkReachPx * kMarkReachPx;
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    const auto& points = set.pieces[k].points;
    for (std::ptrdiff_t i = 0; i < std::ssize(points); ++i) {
      const double distance = (points[i].at - px).squaredNorm();
      if (distance > nearest || (found && distance == nearest)) continue;
      nearest = distance;
      found = PlaceOnPiece{k, i};
    }
  }
  return found;
}

/// The direction of a piece at one of its points, not normalised.
Vec2 directionAt(const Piece& piece, std::ptrdiff_t point) {
  const std::ptrdiff_t last = std::ssize(piece.points) - 1;
  const auto at = [&](std::ptrdiff_t i) { return piece.points[std::clamp<std::ptrdiff_t>(i, 0, last)].at; };
  return at(point + kChordPoints) - at(point - kChordPoints);
}

}  // namespace

DirectionOwners assignDirections(const PieceSet& set, const Recipe& recipe) {
  DirectionOwners owners;
  owners.ofPiece.resize(set.pieces.size());
  for (std::size_t mark = 0; mark < recipe.directions.size(); ++mark) {
    const DirectionMark& wanted = recipe.directions[mark];
    const auto place = placeNear(set, wanted.positionPx);
    if (!place) {
      owners.lostDirections.push_back(mark);
      continue;
    }
    const Vec2 direction = directionAt(set.pieces[place->piece], place->point);
    owners.ofPiece[place->piece] = {mark, direction.dot(wanted.towardsPx - wanted.positionPx) < 0.0};
  }
  for (std::size_t mark = 0; mark < recipe.starts.size(); ++mark) {
    if (const auto place = placeNear(set, recipe.starts[mark].positionPx))
      owners.startOfContour[set.pieces[place->piece].contour] = mark;
    else
      owners.lostStarts.push_back(mark);
  }
  return owners;
}

void reverseDirection(Recipe& recipe, const PieceSet& set, std::size_t piece) {
  const auto& points = set.pieces[piece].points;
  if (points.size() < 2) return;
  const auto now = assignDirections(set, recipe).ofPiece[piece];
  std::erase_if(recipe.directions, [&](const DirectionMark& mark) {
    const auto place = placeNear(set, mark.positionPx);
    return place && place->piece == piece;
  });
  const std::ptrdiff_t middle = std::ssize(points) / 2;
  const Vec2 at = points[middle].at;
  const Vec2 direction = directionAt(set.pieces[piece], middle);
  const bool isReversed = now && now->isReversed;
  if (direction.norm() > 0.0) recipe.directions.push_back({at, at + (isReversed ? direction : Vec2(-direction))});
}

void setStart(Recipe& recipe, const PieceSet& set, std::size_t piece, const Vec2& px) {
  const int contour = set.pieces[piece].contour;
  std::erase_if(recipe.starts, [&](const StartMark& mark) {
    const auto place = placeNear(set, mark.positionPx);
    return place && set.pieces[place->piece].contour == contour;
  });
  recipe.starts.push_back({px});
}

}  // namespace batten
