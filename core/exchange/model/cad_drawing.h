// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/exchange/model/cad_shape.h"
#include "core/exchange/model/export_model.h"
#include "core/exchange/model/export_settings.h"

namespace batten {

/// A document as the entities of a CAD file.
struct CadExport {
  CadDrawing drawing;           ///< Lengths in the unit of the settings.
  double largestErrorMm = 0.0;  ///< Measured distance of the entities from the exact curves, at the size written.
  double largestJump = 0.0;     ///< Cubics: the largest jump of the curvature where two meet, see cubic_path.h.
};

/// Scales the curves, joins them or cuts them, and makes entities of them as the settings say, one after the other in
/// the order of the document. Parameters of curves are their arc length.
/// @return NoCurve if there is nothing to write; BadParameter for settings that make no sense.
Result<CadExport> cadExport(const ExportDocument&, const ExportSettings&, const RunContext& = {});

/// The document at another size: everything in mm times `scale`.
ExportDocument scaled(const ExportDocument&, double scale);

/// Name of a piece in a file: its own, else that of its curve with a number.
std::string entityName(const ExportCurve&, std::size_t piece);

}  // namespace batten
