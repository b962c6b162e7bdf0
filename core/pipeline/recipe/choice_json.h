// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/pipeline/recipe/recipe.h"
#include "core/pipeline/recipe/recipe_json.h"

namespace batten {

/// The part of recipe_file.h about "choices": what was chosen for single curves.
RecipeJson choiceToJson(const PieceChoice&);
/// @return BadParameter that says what is damaged or not known.
Result<PieceChoice> readChoice(const RecipeJson&);

}  // namespace batten
