// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/cancel_check.h"
#include "core/exchange/model/export_model.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// Curves as they were found on the scan, or as they were faired.
enum class ExportedCurves { Faired, Sketched, Both };
/// Widths of the strokes along the curves: measuring them takes long, and few formats hold them (holdsWidths()).
enum class ExportedWidths { Measured, None };

/// What an export of the present result holds: the faired curves the user has not excluded, grouped by contour into
/// paths. Pieces that follow each other form one path, "curve-3" if Curve 3 has the lowest number among them; where a
/// piece is missing (excluded or failed) the line is interrupted and becomes several open paths. Empty curves if the
/// run gave no faired curve. Sketched curves come before faired ones, on a layer of their own, with ids that end in
/// "-sketched"; a piece that was not faired is one of both kinds. Pieces are named and numbered as in the window and
/// the report.
ExportDocument exportDocument(const PipelineOutput&, const Recipe&, const Scan&,
                              ExportedCurves which = ExportedCurves::Faired, ExportedWidths = ExportedWidths::Measured,
                              CancelCheck = {});

}  // namespace batten
