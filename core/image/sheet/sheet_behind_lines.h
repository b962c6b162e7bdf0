// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/image/sheet/sheet_cells.h"

namespace batten {

/// A sheet with the even areas that drawn lines part from it: along half of the line or more their paper is as that of
/// the sheet on the other side. Lines between them are of the sheet, too.
/// @param even the sheet's largest even area, a mask of the cells, not 0 inside.
/// @param areas the number of its even area for each cell, from 0. @param size of these areas, in cells.
cv::Mat1b sheetBehindLines(const cv::Mat1b& even, const cv::Mat1i& areas, const std::vector<int>& size,
                           const SheetCells& cells);

}  // namespace batten
