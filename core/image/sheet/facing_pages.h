// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"
#include "core/image/sheet/shaded_paper.h"
#include "core/image/sheet/sheet_cells.h"

namespace batten {

inline constexpr double kLeastFacingPage = 0.3;  ///< of the sheet's area

/// The facing page of an open book: paper of about the sheet's colour and of its grain across a narrow gutter, with a
/// drawing on it. What reaches two corners of the picture is a table; a blank page holds nothing that would be missed.
/// Masks are of the size of the cells, not 0 inside.
bool isFacingPage(const cv::Mat1b& page, const cv::Mat1b& sheet, const SheetCells& cells, const ShadedPaper& shaded);

/// The pages of an open book on one level of brightness: towards the gutter paper bends away and dims, on one page more
/// than on the other. What is taken out depends on the distance from the gutter and changes slowly along it, so that
/// shading that was drawn stays.
/// @param inside the pages, in squares of cellPx. Absent: there are not two pages, or the run was cancelled.
std::optional<GreyImage> pagesOnOneLevel(const GreyImage& page, const BitImage& inside, int cellPx,
                                         const RunContext& context);

}  // namespace batten
