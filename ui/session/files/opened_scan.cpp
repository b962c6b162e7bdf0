// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/files/opened_scan.h"

#include <string>
#include <system_error>
#include <utility>

#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/image/file/scan_reader.h"
#include "core/pipeline/recipe/recipe_file.h"

namespace batten {

std::filesystem::path recipeBeside(const std::filesystem::path& scan, int page) {
  std::filesystem::path recipe = scan;
  if (page > 1) return recipe.replace_filename(recipe.stem().concat("-p" + std::to_string(page) + ".recipe.json"));
  return recipe.replace_extension(".recipe.json");
}

Result<Recipe> readRecipeFile(const std::filesystem::path& path, const RunContext& context) {
  const std::string name = shownName(path.filename());
  const auto text = readWhole(path, kLargestRecipeBytes);
  if (!text)
    return fail(ErrorCode::BadParameter, name + " cannot be used as a recipe: it " + describe(text.error()) + ".");
  auto recipe = recipeFromJson(*text, context);
  if (!recipe) return fail(recipe.error().code, name + ": " + recipe.error().message, recipe.error().detail);
  return recipe;
}

Result<OpenedScan> openWithRecipe(const std::filesystem::path& path, const std::optional<PageChoice>& page,
                                  const RunContext& context) {
  OpenedScan opened;
  const std::filesystem::path beside = recipeBeside(path, page ? page->number : 1);
  std::error_code ignored;
  if (std::filesystem::exists(beside, ignored)) {
    auto recipe = readRecipeFile(beside, context);
    if (!recipe && recipe.error().code == ErrorCode::Cancelled) return cancelled();
    if (recipe) {
      opened.recipe = std::move(*recipe);
      opened.hasRecipe = true;
    } else {
      opened.problem = recipe.error().message + " The drawing opened without it.";
    }
  }
  if (page) opened.recipe.scanPage = *page;
  auto scan = readScan(path, {.page = opened.recipe.scanPage}, context);
  if (!scan) return fail(std::move(scan).error());
  opened.scan = std::move(*scan);
  return opened;
}

}  // namespace batten
