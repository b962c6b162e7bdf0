// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// Attribute of the filled outline of a stroke: the id of the path in its middle. Such an outline is a picture of that
/// path and its width, no curve of its own.
inline constexpr const char* kWidthOf = "width-of";
/// How the description begins to state the error of the paths; a number in mm follows.
inline constexpr const char* kPathsLieWithin = "The cubic paths lie within ";

struct SvgOptions {
  double toleranceMm = 0.002;  ///< [mm] > 0. Largest distance of the cubics from the exact curves.
  double strokeWidthMm = 0.1;  ///< [mm] > 0.
  bool widthOutlines = false;  ///< Below the paths: the strokes that they are the middle of, filled.
  double unitsPerMm = 1.0;     ///< [1/mm] > 0. User units of the paths; the size of the page is stated in mm always.
};
struct SvgText {
  std::string text;
  double largestErrorMm = 0.0;  ///< Measured, not the bound asked for.
  int cubics = 0;
  int outlines = 0;          ///< Filled outlines of strokes.
  double largestJump = 0.0;  ///< Of the curvature where cubics meet, measured and relative: see cubic_path.h.
};
/// SVG in mm (width and height in mm, 1 user unit = 1 mm unless asked otherwise, y down), one <path> per curve of the
/// drawing, a <g> per layer, cubics within the tolerance of the exact curves and with their curvatures at every joint,
/// both errors stated in <desc>, the exact B-splines in <metadata>.
/// With outlines: below every layer one more, "… width", of the strokes of its curves as filled areas.
/// @return NoCurve if there is nothing to write, Cancelled.
Result<SvgText> writeSvg(const ExportDocument&, const SvgOptions&, const RunContext& = {});

}  // namespace batten
