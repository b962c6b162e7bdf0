// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/edge_choices.h"

#include <algorithm>
#include <cstddef>

namespace batten {
namespace {

constexpr double kLeastBrushRadiusPx = 0.5, kMostBrushRadiusPx = 1000.0;  // a brush of one pixel; limits of input
constexpr std::size_t kMostPlaces = 100'000;                              // of one course, as of a pen stroke

}  // namespace

std::optional<Error> validate(const EdgeChoice& choice) {
  if (choice.positionPx.allFinite()) return std::nullopt;
  return Error{ErrorCode::BadParameter, "The position of a trace mode choice is not a number.", {}};
}

std::optional<Error> validate(const PaintedInk& painted) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadParameter, message, {}}; };
  if (painted.coursePx.empty() || painted.coursePx.size() > kMostPlaces)
    return bad("Painted ink must have 1 to 100000 places.");
  if (!std::ranges::all_of(painted.coursePx, [](const Vec2& p) { return p.allFinite(); }))
    return bad("A place of painted ink is not a number.");
  if (!(painted.radiusPx >= kLeastBrushRadiusPx && painted.radiusPx <= kMostBrushRadiusPx))
    return bad("The radius of painted ink must be 0.5 to 1000 px.");
  return std::nullopt;
}

double scaledRadius(const PaintedInk& painted, double scale) {
  return std::clamp(painted.radiusPx * scale, kLeastBrushRadiusPx, kMostBrushRadiusPx);
}

std::optional<Error> validate(const JunctionChoice& choice) {
  bool isFinite = choice.positionPx.allFinite();
  for (const BranchPair& pair : choice.pairs)
    isFinite = isFinite && pair.firstPx.allFinite() && pair.secondPx.allFinite();
  if (isFinite) return std::nullopt;
  return Error{ErrorCode::BadParameter, "A place of a junction's pairing is not a number.", {}};
}

}  // namespace batten
