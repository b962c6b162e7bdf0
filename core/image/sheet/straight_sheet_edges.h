// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/sheet/sheet_cells.h"

namespace batten {

/// [grey] Paper that is brighter by this than what it encloses lies round a drawn solid, and is no table round a sheet.
inline constexpr double kSolidContrast = 12.0;

/// What lies beyond straight edges of a sheet that run near a side of the picture, a mask (0 or 255) of the cells for
/// each: white paper on a white table differs by a few grey or by its tint alone, too little for single cells, but all
/// along the edge and within a few cells. A drawn line has the same paper on both sides, a shadow fades, a
/// drawn solid is darker.
std::vector<cv::Mat1b> beyondSheetEdges(const SheetCells&, const RunContext&);

}  // namespace batten
