// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// What a journal keeps of a drawing with unsaved changes.
struct UnsavedWork {
  std::string scanPath;  ///< UTF-8, as the window stores paths; empty: a drawing on an empty page.
  Recipe recipe;
};

std::string unsavedWorkToJson(const UnsavedWork&);
/// Reads it back exactly. @return BadParameter if it is no such work: damaged, or without a drawing.
Result<UnsavedWork> unsavedWorkFromJson(std::string_view text);

}  // namespace batten
