// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/recipe_json.h"

#include <cmath>

#include "core/base/number_text.h"

namespace batten {

tl::unexpected<Error> refuseRecipe(std::string message, std::string detail) {
  return fail(ErrorCode::BadParameter, std::move(message), std::move(detail));
}

std::optional<std::string> valueText(const RecipeJson& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) return numberToText(value.get<double>());
  return std::nullopt;
}

std::optional<Vec2> pointFromJson(const RecipeJson& json) {
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number()) return std::nullopt;
  const Vec2 p(json[0].get<double>(), json[1].get<double>());
  return std::isfinite(p.x()) && std::isfinite(p.y()) ? std::optional(p) : std::nullopt;
}

std::optional<int> integerFromJson(const RecipeJson& json) {
  return json.is_number_integer() ? integerFromText(json.dump()) : std::nullopt;
}

std::optional<std::vector<Vec2>> pairsFromJson(const RecipeJson& json) {
  if (!json.is_array()) return std::nullopt;
  std::vector<Vec2> pairs;
  for (const RecipeJson& entry : json) {
    const auto pair = pointFromJson(entry);
    if (!pair) return std::nullopt;
    pairs.push_back(*pair);
  }
  return pairs;
}

}  // namespace batten
