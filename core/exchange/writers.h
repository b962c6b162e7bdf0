// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/exchange/export_model.h"

namespace batten {

struct SvgOptions {
  double toleranceMm = 0.002;  ///< [mm] > 0. Largest distance of the cubics from the exact curves.
  double strokeWidthMm = 0.1;  ///< [mm] > 0.
};
struct SvgText {
  std::string text;
  double largestErrorMm = 0.0;  ///< Measured, not the bound asked for.
  int cubics = 0;
};
/// SVG in mm (width and height in mm, 1 user unit = 1 mm, y down), one <path> per curve of the drawing, cubics within
/// the tolerance of the exact quintics, the error stated in <desc>, the exact B-splines in <metadata>.
/// @return NoCurve if there is nothing to write.
Result<SvgText> writeSvg(const ExportDocument&, const SvgOptions&);

/// What an SVG of ours holds when it is read back.
struct SvgCheck {
  int curves = 0, cubics = 0;
  double largestErrorMm = 0.0;  ///< Largest distance of points of the paths from the exact curves.
};
/// Reads an SVG back and compares it with the document it was written from: as many paths, the exact B-splines of the
/// metadata equal to the last bit, every path along its curve.
/// @return CannotWrite if it holds something else.
Result<SvgCheck> checkSvg(std::string_view text, const ExportDocument&);

/// Curve JSON, "batten-curves" version 1 (see README); numbers with 17 significant digits.
Result<std::string> writeCurveJson(const ExportDocument&);
/// Reads curve JSON back (the self-check after an export, and tests).
Result<ExportDocument> readCurveJson(std::string_view text);

/// Writes all bytes or nothing: to a temporary file beside the target, then renames. CannotWrite says why and what to
/// do.
Result<void> saveAtomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace batten
