// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"
#include "core/image/scan.h"
#include "core/pipeline/recipe/recipe.h"
#include "core/pipeline/run/pipeline.h"

namespace batten::test {

/// The lines of an output, as tracedLines gives them.
std::vector<std::vector<Vec2>> linesOf(const PipelineOutput&);
/// A page as far as its lines are found, before corners and curves.
PipelineOutput tracedPage(const Scan& scan, const Recipe& recipe);
/// The lines of a page as they are found, before corners and curves; a closed one ends where it begins.
std::vector<std::vector<Vec2>> tracedLines(const Scan& scan, const Recipe& recipe);

}  // namespace batten::test
