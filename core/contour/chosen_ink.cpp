// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/chosen_ink.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace batten {
namespace {

double squaredDistance(const Run& run, const Vec2& px) {
  const double x = std::clamp(px.x(), static_cast<double>(run.x0), static_cast<double>(run.x1));
  const double y = std::clamp(px.y(), static_cast<double>(run.y), run.y + 1.0);
  return (px - Vec2(x, y)).squaredNorm();
}

/// The nearest piece within reach; -1 = none. Runs are in reading order, so that rows out of reach are passed over.
int nearestPiece(const RunPieces& pieces, const Vec2& px) {
  const auto above = [](const Run& run, double y) { return run.y < y; };
  auto run = std::lower_bound(pieces.runs.begin(), pieces.runs.end(), std::floor(px.y() - kInkReachPx - 1.0), above);
  double least = kInkReachPx * kInkReachPx;
  int piece = -1;
  for (; run != pieces.runs.end() && run->y <= px.y() + kInkReachPx; ++run) {
    const double distance = squaredDistance(*run, px);
    if (distance > least || (distance == least && piece >= 0)) continue;
    least = distance;
    piece = pieces.piece[run - pieces.runs.begin()];
  }
  return piece;
}

}  // namespace

std::optional<Error> validate(const EdgeChoice& choice) {
  if (choice.positionPx.allFinite()) return std::nullopt;
  return Error{ErrorCode::BadParameter, "The place of a line that is followed in its own way is not a number.", {}};
}

ChosenInk::ChosenInk(const RunPieces& pieces, std::span<const EdgeChoice> choices) : pieces_(pieces) {
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const int piece = nearestPiece(pieces, choices[i].positionPx);
    if (piece >= 0) {
      chosen_.emplace_back(piece, static_cast<int>(i));
    } else {
      withoutInk_.push_back(choices[i]);
    }
  }
}

int ChosenInk::choiceOf(int piece) const {
  for (auto one = chosen_.rbegin(); one != chosen_.rend(); ++one) {
    if (one->first == piece) return one->second;
  }
  return -1;
}

int ChosenInk::choiceAt(const Vec2& px) const {
  if (chosen_.empty()) return -1;
  const int x = static_cast<int>(std::floor(px.x())), y = static_cast<int>(std::floor(px.y()));
  constexpr std::array<std::pair<int, int>, 9> kNear = {
      {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  for (const auto& [dx, dy] : kNear) {
    if (const auto piece = pieceAt(pieces_, x + dx, y + dy)) return choiceOf(*piece);
  }
  return -1;
}

}  // namespace batten
