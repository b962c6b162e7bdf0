// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/exchange/export_model.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// Curves as they were found on the scan, or as they were faired.
enum class ExportedCurves { Faired, Sketched, Both };

/// What an export of the present result holds: the faired curves the user has not excluded, grouped by contour into
/// curves "curve-1" …. Pieces that follow each other form one curve; where a piece is missing (excluded or failed) the
/// line is interrupted and becomes several open curves. Empty curves if the run gave no faired curve.
/// Sketched curves come before faired ones, on a layer of their own, with ids that end in "-sketched"; a piece that was
/// not faired is one of both kinds. Pieces are named as the window numbers them.
ExportDocument exportDocument(const PipelineOutput&, const Recipe&, const Scan&,
                              ExportedCurves which = ExportedCurves::Faired);

}  // namespace batten
