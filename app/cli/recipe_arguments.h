// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/trace_command.h"
#include "core/base/result.h"
#include "core/image/scan.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten::cli {

/// The recipe that the words ask for: recipe file first, then --set in the order given, then corners, regions and
/// resolution. @return BadParameter with what to do.
Result<Recipe> recipeOf(const TraceArguments&);

/// That the file holds further pages, unless a page was asked for.
std::optional<std::string> otherPagesNote(const TraceArguments&, const Recipe&, const Scan&);

}  // namespace batten::cli
