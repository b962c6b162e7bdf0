// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "core/image/sheet/sheet_cells.h"

namespace batten {

/// The quadrilateral that an even area of the picture fills, a mask (0 or 255) of the cells: a sheet that lies free in
/// the picture, however small, or a whiteboard. Its four sides are straight and seen on most of their length, what is
/// beside them is darker at once (a drawn frame has the same paper on both sides), and nothing else in the picture is
/// as bright and as even: that would be the paper round a panel, or a second sheet, and drawn upon. Absent: there is
/// none.
/// @param even the area with all that it encloses, a mask of the cells, not 0 inside.
std::optional<cv::Mat1b> straightSidedSheet(const cv::Mat1b& even, const SheetCells& cells);

}  // namespace batten
