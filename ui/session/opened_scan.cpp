// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/opened_scan.h"

#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "core/image/scan_reader.h"
#include "core/pipeline/recipe/recipe_file.h"

namespace batten {
namespace {

/// Recipes hold some kilobytes; what is far larger is something else under that name.
constexpr std::uintmax_t kLargestRecipeBytes = 64u << 20;

}  // namespace

std::filesystem::path recipeBeside(const std::filesystem::path& scan) {
  std::filesystem::path recipe = scan;
  return recipe.replace_extension(".recipe.json");
}

Result<Recipe> readRecipeFile(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  std::error_code ignored;
  if (const auto size = std::filesystem::file_size(path, ignored); !ignored && size > kLargestRecipeBytes)
    return fail(ErrorCode::BadParameter, name + " is no recipe: it is too large.");
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) return fail(ErrorCode::UnreadableScan, name + " cannot be read.");
  auto recipe = recipeFromJson(text);
  if (!recipe) return fail(recipe.error().code, name + ": " + recipe.error().message, recipe.error().detail);
  return recipe;
}

Result<OpenedScan> openWithRecipe(const std::filesystem::path& path, const RunContext& context) {
  auto scan = readScan(path, ScanLimits{}, context);
  if (!scan) return fail(std::move(scan).error());
  OpenedScan opened{std::move(*scan), Recipe{}, false, {}};
  const std::filesystem::path beside = recipeBeside(path);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(beside, ignored)) return opened;
  auto recipe = readRecipeFile(beside);
  if (recipe) {
    opened.recipe = std::move(*recipe);
    opened.hasRecipe = true;
  } else {
    opened.problem = recipe.error().message + " The drawing opened without it.";
  }
  return opened;
}

}  // namespace batten
