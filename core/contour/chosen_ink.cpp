// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/chosen_ink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace batten {
namespace {

double squaredDistanceToRun(const InkRun& run, const Vec2& px) {
  const double x = std::clamp(px.x(), static_cast<double>(run.x0), static_cast<double>(run.x1));
  const double y = std::clamp(px.y(), static_cast<double>(run.y), run.y + 1.0);
  return (px - Vec2(x, y)).squaredNorm();
}

/// The nearest piece within reach, if there is one. Runs are in reading order, so that rows out of reach are passed
/// over.
std::optional<int> nearestPiece(const RunPieces& pieces, const Vec2& px, double reachPx) {
  const auto above = [](const InkRun& run, double y) { return run.y < y; };
  auto run = std::lower_bound(pieces.runs.begin(), pieces.runs.end(), std::floor(px.y() - reachPx - 1.0), above);
  double least = reachPx * reachPx;
  std::optional<int> piece;
  for (; run != pieces.runs.end() && run->y <= px.y() + reachPx; ++run) {
    const double distance = squaredDistanceToRun(*run, px);
    if (distance > least || (distance == least && piece)) continue;
    least = distance;
    piece = pieces.piece[run - pieces.runs.begin()];
  }
  return piece;
}

}  // namespace

ChosenInk::ChosenInk(const RunPieces& pieces, std::span<const EdgeChoice> choices) : pieces_(pieces) {
  for (int i = 0; i < std::ssize(choices); ++i) {
    if (const auto piece = nearestPiece(pieces, choices[i].positionPx, choices[i].reachPx)) {
      chosen_.push_back({*piece, i});
    } else {
      withoutInk_.push_back(choices[i]);
    }
  }
}

std::optional<int> ChosenInk::choiceOf(int piece) const {
  const auto last = std::find_if(chosen_.rbegin(), chosen_.rend(), [&](const Chosen& c) { return c.piece == piece; });
  return last == chosen_.rend() ? std::nullopt : std::optional(last->choice);
}

std::optional<int> ChosenInk::choiceAt(const Vec2& px) const {
  if (chosen_.empty()) return std::nullopt;
  const int x = static_cast<int>(std::floor(px.x())), y = static_cast<int>(std::floor(px.y()));
  // The pixel itself, then its neighbours, the nearer ones first.
  constexpr std::array<std::pair<int, int>, 9> kNear = {
      {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  for (const auto& [dx, dy] : kNear) {
    if (const auto piece = pieceAt(pieces_, x + dx, y + dy)) return choiceOf(*piece);
  }
  return std::nullopt;
}

}  // namespace batten
