// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/base/result.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// The part of recipe_file.h about "scale", "directions", "starts" and "junctions".

/// Reads one of these entries. @return false for another name; BadParameter if the entry is damaged.
Result<bool> readPlacedMark(const std::string& name, const nlohmann::ordered_json& value, Recipe&);
/// Adds the entries of which there are any.
void addPlacedMarks(const Recipe&, nlohmann::ordered_json&);

}  // namespace batten
