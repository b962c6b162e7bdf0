// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
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

/// The cell at a place [cells]; absent outside the picture.
std::optional<cv::Point> cellAt(const SheetCells&, const Vec2& place);
/// [cells] From a place, both included.
struct CellRange {
  int from = 0, to = 0;
};
/// [grey] Brightness of the cells of the picture at these distances from a place. @param towards a unit vector.
std::vector<float> levelsAlong(const SheetCells&, const Vec2& place, const Vec2& towards, const CellRange& at);

}  // namespace batten
