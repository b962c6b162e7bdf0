// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/pipeline/run/pipeline.h"

namespace batten {

/// One piece constructed alone as `recipe.construct` says: what it becomes when that is its own method and the other
/// pieces of its line keep theirs. Changes and caches nothing; `faired` stays empty.
Result<TracedCurve> constructPiece(const PipelineOutput&, const Recipe& recipe, int piece, const RunContext&);

/// One line constructed as `recipe.construct` says, to compare methods with; changes and caches nothing. `faired` stays
/// empty. One entry per piece of the line in the order of the pieces; without a curve where its construction failed.
Result<std::vector<TracedCurve>> constructLine(const PipelineOutput&, const Recipe& recipe, int contour,
                                               const RunContext&);

}  // namespace batten
