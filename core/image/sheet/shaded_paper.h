// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/image/sheet/sheet_cells.h"

namespace batten {

inline constexpr float kMostSheetStep = 7.0f;  ///< [grey] from cell to cell of one sheet, in brightness and in colour
/// Whether two cells, side by side or across a line, may be of one sheet: grey, red less grey, blue less grey.
inline bool isOneSheet(const cv::Vec3f& a, const cv::Vec3f& b) {
  const cv::Vec3f apart = a - b;
  return std::max({std::fabs(apart[0]), std::fabs(apart[1]), std::fabs(apart[2])}) <= kMostSheetStep;
}
inline constexpr double kDarkestOnSheet = 0.6;  ///< of its brightness: behind a fold or in a shadow it is no darker
inline constexpr double kSameGrain = 1.25;      ///< times the roughness of paper: no more if it is the same paper
inline constexpr double kLeastGrain = 1.5;      ///< [grey] less cannot be told from none
inline constexpr int kSheetEdgeCells = 7;       ///< The sheet's edge and its shadow are of neither side.

/// What paper is like where nothing is drawn: the smoother half of its cells, for ink makes cells rough.
struct PaperLook {
  cv::Vec3f colour;  ///< Grey, red less grey, blue less grey.
  float rough = 0.0f;
};
PaperLook paperLookOf(const cv::Mat1b& sheet, const SheetCells& cells);

/// What tells the sheet itself in shade, behind a fold or in a shadow, from a table: it has the sheet's colour and
/// grain, is not much darker, and either its grain is exactly the same or the drawing goes on upon it. Masks are of
/// the size of the cells, not 0 inside.
class ShadedPaper {
 public:
  ShadedPaper(const cv::Mat1b& sheet, const SheetCells& cells);
  /// Whether a patch is the sheet itself in shade.
  bool isOne(const cv::Mat1b& patch) const;
  /// Whether the drawing goes on upon a patch.
  bool isDrawnOn(const cv::Mat1b& patch) const;
  /// Whether the paper of the sheet, as bright and even as on the sheet, shows near most places of a patch between what
  /// is drawn there: text and dense lines up to the border of the picture. Most tables show it nowhere.
  bool showsThrough(const cv::Mat1b& patch) const;

 private:
  const SheetCells& cells_;
  cv::Mat1b drawn_, near_, sheet_;
  cv::Scalar mean_;
  double rough_ = 0.0, drawnOnSheet_ = 0.0;
};

}  // namespace batten
