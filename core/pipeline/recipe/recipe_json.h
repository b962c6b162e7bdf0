// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/vec2.h"

namespace batten {

/// Values of a recipe's file, and the error of one that is damaged; each reader gives nothing for another kind of
/// value.
using RecipeJson = nlohmann::ordered_json;

/// BadParameter.
tl::unexpected<Error> refuseRecipe(std::string message, std::string detail = {});

/// A JSON value as the text that the setters of the parameter table take.
std::optional<std::string> valueText(const RecipeJson&);
/// [x, y], finite.
std::optional<Vec2> pointFromJson(const RecipeJson&);
/// [[x, y]…]
std::optional<std::vector<Vec2>> pairsFromJson(const RecipeJson&);
/// A whole number that fits; one that does not is none, never what is left of it.
std::optional<int> integerFromJson(const RecipeJson&);

}  // namespace batten
