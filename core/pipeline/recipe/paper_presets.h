// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// All settings with which a paper's own way is repeated at once.
struct PaperPreset {
  std::string id;     ///< "000" …, or "default": the program's own way.
  std::string title;  ///< "Quintic NURBS from a sketch"
  std::string cost;   ///< What the paper's choices cost, in one line; empty for the program's own way.
  std::vector<std::pair<std::string, std::string>> settings;  ///< Names and values of the parameter table.
};

/// 000, 001, 002, 004 and "default". 003 describes the targets of 000: it has no way of its own.
std::span<const PaperPreset> paperPresets();
/// @return nullptr if there is none of that id.
const PaperPreset* findPaperPreset(std::string_view id);
std::string paperPresetNames();  ///< "000, 001, 002, 004, default"

/// Sets what the preset names, and what only other presets name back to its default. Nothing else changes.
Result<void> applyPaperPreset(const PaperPreset&, Recipe&);
/// The preset whose settings a recipe has, all of them; null if it has none's.
const PaperPreset* paperPresetOf(const Recipe&);

}  // namespace batten
