// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "core/image/sheet/sheet_cells.h"

namespace batten {

inline constexpr double kLeastPatch =
    0.004;                                  ///< of the picture: smaller patches at the border are ink that runs off it
inline constexpr double kNeckShare = 0.01;  ///< of the diagonal: narrower parts are torn edges and ring holes

/// A disc whose radius is a share of the diagonal, at least one cell.
cv::Mat discOf(const cv::Size& size, double shareOfDiagonal);
/// The outermost cells.
cv::Mat1b borderOf(const cv::Size& size);

/// What lies beside the sheet without what hangs on it by a narrow neck only: a shape whose outline was drawn up to the
/// edge of the sheet encloses paper. Masks are of the size of the cells, not 0 inside.
cv::Mat1b withoutPockets(const cv::Mat1b& beside);

/// The sheet with the large parts beside it that bulge into it: a sheet is about convex, so its edge runs along its
/// hull where a table is beside it. A shape that was shaded up to the border of the picture is convex itself.
cv::Mat1b withTonesThatBulge(const cv::Mat1b& sheet);

/// What lies beside the sheet without tones that were drawn up to its edge: broad parts within the hull of its even
/// area that the table does not go on in.
cv::Mat1b withoutTonesAtEdge(const cv::Mat1b& beside, const cv::Mat1b& even, const SheetCells& cells);

/// Whether what was taken for a sheet is paper within a drawn frame: along most of its edge a dark line runs between
/// paper of about the same brightness. The edge of a sheet is a step, and its shadow is paler.
bool isDrawnFrame(const cv::Mat1b& sheet, const SheetCells& cells);

}  // namespace batten
