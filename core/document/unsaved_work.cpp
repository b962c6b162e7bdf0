// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/unsaved_work.h"

#include <nlohmann/json.hpp>

#include "core/base/json_text.h"
#include "core/pipeline/recipe/recipe_file.h"

namespace batten {

std::string unsavedWorkToJson(const UnsavedWork& work) {
  // The recipe in a text of its own: it is read as any recipe is.
  const nlohmann::ordered_json json{{"recipe", recipeToJson(work.recipe)}, {"scan", work.scanPath}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Result<UnsavedWork> unsavedWorkFromJson(std::string_view text) {
  const auto damaged = [](const std::string& why) {
    return fail(ErrorCode::BadParameter, "The unsaved work cannot be read: " + why + ".");
  };
  const auto json = parseJson(text);
  if (!json) return damaged(json.error().message);
  const auto textOf = [&](const char* name) -> const std::string* {
    if (!json->is_object()) return nullptr;
    const auto found = json->find(name);
    return found == json->end() ? nullptr : found->get_ptr<const std::string*>();
  };
  const std::string *recipeText = textOf("recipe"), *scan = textOf("scan");
  if (recipeText == nullptr || scan == nullptr) return damaged("it names no drawing");
  auto recipe = recipeFromJson(*recipeText);
  if (!recipe) return fail(recipe.error());
  if (scan->empty() && !recipe->page) return damaged("it has neither a scan nor a page");
  return UnsavedWork{*scan, std::move(*recipe)};
}

}  // namespace batten
