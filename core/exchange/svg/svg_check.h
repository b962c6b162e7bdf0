// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// What an SVG of ours holds when it is read back.
struct SvgCheck {
  int curves = 0, cubics = 0;        ///< Paths of curves, and cubics in them.
  double largestErrorMm = 0.0;       ///< Largest distance of points of the paths from the exact curves.
  int outlines = 0;                  ///< Filled outlines of strokes.
  double largestWidthErrorMm = 0.0;  ///< Largest distance of their borders from half the width beside the curves.
};
/// Reads an SVG back and compares it with the document it was written from: as many paths, the exact B-splines of the
/// metadata equal to the last bit, every path along its curve; every filled outline around a curve that has a width.
/// @return CannotWrite if it holds something else, Cancelled.
Result<SvgCheck> checkSvg(std::string_view text, const ExportDocument&, const RunContext& = {});

}  // namespace batten
