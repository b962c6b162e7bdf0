// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/image/sheet/sheet_cells.h"

namespace batten {

/// Where the largest even area of a picture is a table, the sheet that lies upon it: the hull of the even areas that
/// are brighter than the table, however a drawing parts them, if it is about a rectangle, a large part of the picture,
/// holds hardly any table, ends at an edge (sheet_step.h), and most of what lies beside it is the table. Absent: there
/// is none.
/// @param areas of every cell the even area that it lies in, from 0.
/// @param size [cells] of these areas.
/// @param largest of them.
std::optional<cv::Mat1b> sheetOnTable(const cv::Mat1i& areas, const std::vector<int>& size, int largest,
                                      const SheetCells& cells);

}  // namespace batten
