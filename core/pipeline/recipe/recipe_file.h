// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// Recipe as JSON:
/// {"format":"batten-recipe","version":1,"parameters":{name:value…},"corners":[[x,y]…],"dpi":…,"choices":[…],
/// "strokes":[{"closed":false,"points":[[x,y]…]}…],"page":[width,height],
/// "ways":[{"at":[x,y],"mode":"outline"}…]}; the last three only where there are any. All
/// parameters are written, defaults too, so that a recipe keeps its meaning when a default changes.
std::string recipeToJson(const Recipe&);
/// Reads it back exactly. Missing parameters take their default; unknown ones, a wrong format or a newer version are
/// refused with a message that names them.
Result<Recipe> recipeFromJson(std::string_view json);

}  // namespace batten
