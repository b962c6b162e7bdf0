// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/exchange/export_model.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// What an export of the present result holds: the faired curves the user has not excluded, grouped by contour into
/// curves "curve-1" …. Pieces that follow each other form one curve; where a piece is missing (excluded or failed) the
/// line is interrupted and becomes several open curves. Empty curves if the run gave no faired curve.
ExportDocument exportDocument(const PipelineOutput&, const Recipe&, const Scan&);

}  // namespace batten
