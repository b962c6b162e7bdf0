// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a recipe: refused with a reason, or a recipe that is written and read back as itself.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/pipeline/recipe/recipe_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto recipe = batten::recipeFromJson({reinterpret_cast<const char*>(data), size});
  if (!recipe) {
    if (recipe.error().message.empty()) std::abort();
    return 0;
  }
  const auto again = batten::recipeFromJson(batten::recipeToJson(*recipe));
  if (!again || *again != *recipe) std::abort();
  return 0;
}
