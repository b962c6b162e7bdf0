// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "core/image/sheet/sheet_cells.h"

namespace batten {

/// Whether a sheet ends at a patch beside it: along half of their common border or more, brightness, tint or grain
/// differ at once, within a few cells. Paper in slanting light changes as much, but slowly. Masks are of the size of
/// the cells, not 0 inside. True where most of a patch is too narrow to be looked at.
bool isStepBetween(const cv::Mat1b& sheet, const cv::Mat1b& patch, const SheetCells& cells);

/// The sheet with what it becomes slowly: grain grows coarser and paper darker under slanting light, but not within a
/// few cells. The blur along an edge may be of it.
cv::Mat1b slowlyContinued(const cv::Mat1b& sheet, const SheetCells& cells);

}  // namespace batten
