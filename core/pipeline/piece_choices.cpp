// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pipeline/pipeline.h"

namespace batten {
namespace {

/// [px] A choice farther than this from every line has lost its line.
constexpr double kAnchorReachPx = 24.0;

double distanceTo(const Piece& piece, const Vec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec2& q : piece.points) nearest = std::min(nearest, (q - p).squaredNorm());
  return std::sqrt(nearest);
}

/// The piece nearest to a place, the first of equals; none beyond the reach.
std::optional<std::size_t> nearestPiece(const PieceSet& set, const Vec2& p) {
  std::optional<std::size_t> owner;
  double nearest = kAnchorReachPx;
  for (std::size_t piece = 0; piece < set.pieces.size(); ++piece) {
    const double distance = distanceTo(set.pieces[piece], p);
    if (distance > nearest || (owner && distance == nearest)) continue;
    nearest = distance;
    owner = piece;
  }
  return owner;
}

}  // namespace

std::optional<std::size_t> choiceFor(const Piece& piece, const Recipe& recipe) {
  std::optional<std::size_t> best;
  double nearest = kAnchorReachPx;
  for (std::size_t i = 0; i < recipe.choices.size(); ++i) {
    const double distance = distanceTo(piece, recipe.choices[i].anchorPx);
    if (distance > nearest) continue;
    nearest = distance;
    best = i;
  }
  return best;
}

std::vector<std::optional<std::size_t>> assignChoices(const PieceSet& set, const Recipe& recipe) {
  std::vector<std::optional<std::size_t>> assigned(set.pieces.size());
  std::vector<double> distances(set.pieces.size(), kAnchorReachPx);
  for (std::size_t choice = 0; choice < recipe.choices.size(); ++choice) {
    const auto owner = nearestPiece(set, recipe.choices[choice].anchorPx);
    if (!owner) continue;
    const double nearest = distanceTo(set.pieces[*owner], recipe.choices[choice].anchorPx);
    // Two choices for one piece can come from an undone split: the nearer one counts, the later one of equals.
    if (nearest > distances[*owner]) continue;
    assigned[*owner] = choice;
    distances[*owner] = nearest;
  }
  return assigned;
}

std::vector<std::vector<std::size_t>> assignExtremumChoices(const PieceSet& set, const Recipe& recipe) {
  std::vector<std::vector<std::size_t>> assigned(set.pieces.size());
  for (std::size_t i = 0; i < recipe.extremumChoices.size(); ++i) {
    if (const auto owner = nearestPiece(set, recipe.extremumChoices[i].positionPx)) assigned[*owner].push_back(i);
  }
  return assigned;
}

Vec2 anchorOf(const Piece& piece) {
  return piece.points.empty() ? Vec2(Vec2::Zero()) : piece.points[piece.points.size() / 2];
}

}  // namespace batten
