// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "core/base/run_context.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// A picture in squares of a few pixels: what the sheet of paper in it is found by.
struct SheetCells {
  /// [px] side of a cell; cells across and down.
  int sizePx = 1, columns = 0, rows = 0;
  bool hasTint = false;  ///< Of a grey picture the second and third of `colour` are 0.
  cv::Mat3f colour;      ///< Grey, red less grey, blue less grey; without ink.
  cv::Mat1f rough;       ///< Mean difference of neighbours.
  cv::Mat1f dark;        ///< [grey] The darkest pixel: a line through the cell shows.
};
inline constexpr int kSheetCells = 400;       ///< Along the longer side of the picture.
inline constexpr int kFewestSheetCells = 40;  ///< Along the shorter side: on fewer nothing is sought.
/// At least 2 px a cell, about 400 of them along the longer side. An empty colour image: the picture is grey.
SheetCells sheetCellsOf(const GreyImage&, const ColourImage&, const RunContext&);

}  // namespace batten
