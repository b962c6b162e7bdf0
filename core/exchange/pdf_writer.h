// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/export_model.h"
#include "core/exchange/model/export_settings.h"

namespace batten {

struct PdfText {
  std::string bytes;
  double largestErrorMm = 0.0;  ///< Measured, not the bound asked for.
  double largestJump = 0.0;     ///< Of the curvature where cubics meet, see cubic_path.h.
  int cubics = 0;
};
/// One page of the drawing's true size (MediaBox in points to a billionth, pages above 5 m by UserUnit), vector paths
/// of cubics as in the SVG, a marked layer of its own for every layer. The content stream holds millimetres as they
/// are, unpacked, so that any text editor shows them.
Result<PdfText> writePdf(const ExportDocument&, const ExportSettings&, const RunContext& = {});

/// Reads the paths of such a file back: the largest distance from the curves, in mm.
/// @return CannotWrite if it holds other paths, Cancelled.
Result<double> checkPdf(std::string_view bytes, const ExportDocument&, const RunContext& = {});

}  // namespace batten
