// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "core/base/run_context.h"
#include "core/exchange/model/export_model.h"
#include "core/exchange/model/export_settings.h"

namespace batten {

/// What was written, and how the file compares with the curves.
struct ExportReport {
  std::filesystem::path path;
  ExportFormat format = ExportFormat::Svg;
  int curves = 0;                        ///< Lines of the drawing, as in curve JSON.
  int pieces = 0;                        ///< Of the curves, from corner to corner.
  int entities = 0;                      ///< Of the file: splines, lines, arcs, polylines, paths, rows of polynomials.
  int vertices = 0;                      ///< Of polylines.
  int cubics = 0;                        ///< Of paths.
  int doubles = 0;                       ///< Pieces left out because they lie on another one.
  std::optional<double> largestErrorMm;  ///< What the approximation costs, measured; absent for exact files.
  int outlines = 0;                      ///< SVG: strokes as filled outlines of their width …
  double largestWidthErrorMm = 0.0;      ///< … and how far their borders are from it, measured.
  std::optional<double> largestJump;     ///< Of the curvature where cubics meet, relative (see cubic_path.h).
  double largestDifferenceMm = 0.0;      ///< Of what was read back from what was to be written.
};

/// The bytes of an export, checked: they were read back, and hold what they should.
struct ExportedFile {
  std::string bytes;
  ExportReport report;  ///< Without a path.
};

/// Writes the document as the settings say, into memory, and reads it back: exact formats must hold the curves to 1e-9
/// of their size, approximating ones within their tolerance, else nothing is returned.
/// @return NoCurve for an empty document, CannotWrite if the file reads back as something else, Cancelled.
Result<ExportedFile> exportedFile(const ExportDocument&, const ExportSettings&, const RunContext& = {});

/// The same into a file, written whole or not at all; then the file is read and must hold the bytes that were checked.
/// What stood there before stays if anything fails before the file is put in place.
Result<ExportReport> exportToFile(const ExportDocument&, const ExportSettings&, const std::filesystem::path&,
                                  const RunContext& = {});

/// The report in one sentence: "4 curves, read back, largest difference 3e-12 mm"; "2 curves in 9 pieces" where there
/// are corners.
std::string sentenceOf(const ExportReport&);
/// The same in the words of the window, where every piece is a curve with a number: "9 curves joined into 2, read …".
std::string sentenceByNumbers(const ExportReport&);

/// The curves of a document whose numbers are these; a line that lacks some of its pieces becomes several. Pieces
/// without a number are counted from 1 through all lines, in order. Numbers that no curve has say nothing.
ExportDocument onlyCurves(const ExportDocument&, const std::set<int>& numbers);

/// The curves of a document that are named in a list like "1,3-5": by the numbers of
/// their pieces; pieces without one are counted from 1 through all lines, in order. @return BadParameter for a list
/// that makes no sense or a number that no curve has.
Result<ExportDocument> chosenCurves(const ExportDocument&, const std::string& list);

}  // namespace batten
