// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/opened_scan.h"

#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "core/image/scan_reader.h"
#include "core/pipeline/recipe_file.h"

namespace batten {
namespace {

/// Recipes hold some kilobytes; what is far larger is something else under that name.
constexpr std::uintmax_t kLargestRecipeBytes = 64u << 20;

}  // namespace

std::filesystem::path recipeBeside(const std::filesystem::path& scan) {
  std::filesystem::path recipe = scan;
  return recipe.replace_extension(".recipe.json");
}

Result<OpenedScan> openWithRecipe(const std::filesystem::path& path, const RunContext& context) {
  auto scan = readScan(path, ScanLimits{}, context);
  if (!scan) return fail(std::move(scan).error());
  OpenedScan opened{std::move(*scan), Recipe{}, false, {}};
  const std::filesystem::path beside = recipeBeside(path);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(beside, ignored)) return opened;
  const std::string name = beside.filename().string();
  const std::string instead = " The drawing opened without it.";
  if (const auto size = std::filesystem::file_size(beside, ignored); ignored || size > kLargestRecipeBytes) {
    opened.problem = name + " is no recipe: it is too large." + instead;
    return opened;
  }
  std::ifstream file(beside, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) {
    opened.problem = name + " cannot be read." + instead;
    return opened;
  }
  auto recipe = recipeFromJson(text);
  if (recipe) {
    opened.recipe = std::move(*recipe);
    opened.hasRecipe = true;
  } else {
    opened.problem = name + ": " + recipe.error().message + instead;
  }
  return opened;
}

}  // namespace batten
