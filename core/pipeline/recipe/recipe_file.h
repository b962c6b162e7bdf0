// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// Recipe as JSON:
/// {"format":"batten-recipe","version":1,"parameters":{name:value…},"corners":[[x,y]…],"dpi":…,"choices":[…],
/// "strokes":[{"closed":false,"points":[[x,y]…]}…],"page":[width,height] or [width,height,left,bottom],
/// "imports":[…] (imports_json.h),"scan_page":{"number":2,"pdf_dpi":300},"ways":[{"at":[x,y],"mode":"outline"}…],
/// "curves":{"last":7,"known":[{"number":1,"places":[[x,y]…]}…]},"scale":{"from":[x,y],"to":[x,y],"mm":…},
/// "directions":[{"at":[x,y],"towards":[x,y]}…],"starts":[[x,y]…]}; all behind "choices" only where there are any. All
/// parameters are written, defaults too, so that a recipe keeps its meaning when a default changes.
std::string recipeToJson(const Recipe&);
/// Reads it back exactly. Missing parameters take their default; unknown ones, a wrong format or a newer version are
/// refused with a message that names them. Damage and attacks end early (json_text.h); a cancel is heard.
Result<Recipe> recipeFromJson(std::string_view json, const RunContext& context = {});

/// [bytes] Recipes hold some kilobytes, pen drawings some megabytes; what is larger is something else.
inline constexpr std::uint64_t kLargestRecipeBytes = std::uint64_t{64} << 20;

}  // namespace batten
