// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe.h"

#include <cmath>

namespace batten {
namespace {

/// Resolutions that a drawing can have: coarser or finer ones are typing errors.
constexpr double kMinDpi = 1.0, kMaxDpi = 100000.0;

std::optional<Error> bad(std::string message) { return Error{ErrorCode::BadParameter, std::move(message), {}}; }

bool isFinite(const Vec2& p) { return std::isfinite(p.x()) && std::isfinite(p.y()); }

std::optional<Error> validateChoice(const PieceChoice& choice) {
  if (!isFinite(choice.anchorPx)) return bad("A choice for a curve has no valid position.");
  if (choice.target && (*choice.target < 0 || *choice.target > 6)) {
    return bad("The target of a curve must be 0 (recommended) or 1 to 6, not " + std::to_string(*choice.target) + ".");
  }
  if (choice.toleranceMm && !(*choice.toleranceMm >= 0.001 && *choice.toleranceMm <= 20.0)) {
    return bad("The tolerance of a curve must be between 0.001 and 20 mm.");
  }
  return std::nullopt;
}

}  // namespace

std::optional<Error> validate(const Recipe& recipe) {
  if (recipe.dpi && !(*recipe.dpi >= kMinDpi && *recipe.dpi <= kMaxDpi)) {
    return bad("The resolution must be between 1 and 100000 dpi.");
  }
  if (auto e = validate(recipe.log)) return e;
  if (auto e = validate(recipe.threshold)) return e;
  if (auto e = validate(recipe.filter)) return e;
  if (auto e = validate(recipe.edges)) return e;
  if (auto e = validate(recipe.contours)) return e;
  if (auto e = validate(recipe.corners)) return e;
  for (const CornerMark& mark : recipe.cornerMarks) {
    if (!isFinite(mark.positionPx)) return bad("A corner mark has no valid position.");
  }
  if (auto e = validate(recipe.segments)) return e;
  if (auto e = validate(recipe.construct)) return e;
  if (auto e = validate(recipe.fairing)) return e;
  for (const PieceChoice& choice : recipe.choices) {
    if (auto e = validateChoice(choice)) return e;
  }
  return std::nullopt;
}

}  // namespace batten
