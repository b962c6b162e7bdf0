// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// Reads the curves of a file, whoever wrote it: curve JSON, SVG of Batten's own, DXF, IGES, STEP; the ending says
/// which. Lengths in mm, of a file without a unit as if it were mm. Every entity of a CAD file is a line of its own,
/// and the page ends a millimetre beyond the curves.
/// @return BadParameter with what to do if it cannot be read, NoCurve if it holds no curve.
Result<ExportDocument> readCurveFile(const std::filesystem::path&);

}  // namespace batten
