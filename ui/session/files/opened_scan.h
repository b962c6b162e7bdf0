// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/image/scan.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// A scan with the recipe that lies beside it, if one does.
struct OpenedScan {
  Scan scan;
  Recipe recipe;  ///< The defaults when no recipe lies there or it cannot be used.
  bool hasRecipe = false;
  std::string problem;  ///< Why the recipe beside the scan was not used; empty = none there, or all well.
};

/// Where a recipe is saved by itself and looked for: "drawing.recipe.json" beside "drawing.png",
/// "drawing-p2.recipe.json" for page 2 of a file.
std::filesystem::path recipeBeside(const std::filesystem::path& scan, int page = 1);

/// Reads a recipe. What is no ordinary file, or far larger than any recipe, is refused unread.
Result<Recipe> readRecipeFile(const std::filesystem::path& path, const RunContext& context = {});

/// Reads both. A damaged recipe does not keep the scan from opening.
/// @param page of the file; absent: that of the recipe beside it, else the first.
Result<OpenedScan> openWithRecipe(const std::filesystem::path& scan, const std::optional<PageChoice>& page,
                                  const RunContext&);

}  // namespace batten
