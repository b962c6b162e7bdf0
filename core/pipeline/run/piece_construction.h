// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/pipeline/run/pipeline.h"

namespace batten {

/// One piece constructed alone as `recipe.construct` says: what it becomes when that is its own method and the other
/// pieces of its line keep theirs (see constructLine for the whole line). Changes and caches nothing; `faired` stays
/// empty.
Result<TracedCurve> constructPiece(const PipelineOutput&, const Recipe& recipe, int piece, const RunContext&);

}  // namespace batten
