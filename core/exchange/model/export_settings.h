// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace batten {

/// The files that hold curves. The order is the order in which they are offered.
enum class ExportFormat { Svg, Json, Dxf, Iges, Step, Pdf, Csv, Polynomials, Rhino };

/// Who reads a DXF. Cad: every curve as one SPLINE of its own degree, exact. Laser: one cubic SPLINE per Bezier piece,
/// which programs draw that know no other. Cnc: R12 polylines, which every machine reads.
enum class DxfProfile { Cad, Laser, Cnc };

/// How a curve is written to IGES and STEP. Exact: as it is. BezierSegments: each polynomial piece a curve of its own,
/// exact. Cubic: one curve of degree 3 within the tolerance, for receivers that take no higher degree.
enum class CurveFlavour { Exact, BezierSegments, Cubic };

/// The unit of the numbers of a DXF, IGES, STEP, 3DM, CSV or list of polynomials. SVG, PDF and JSON are in mm always.
enum class LengthUnit { Millimetre, Inch };

struct ExportSettings {
  ExportFormat format = ExportFormat::Svg;
  LengthUnit unit = LengthUnit::Millimetre;
  double scale = 1.0;  ///< [-] > 0. The file's curves are this many times as large as the drawing's.
  /// Pieces that follow each other become one curve, with their corners inside; absent: as isJoined() says.
  std::optional<bool> joined;
  bool splinesOnly = false;  ///< Lines, arcs and circles as splines, too.
  bool simpleKnots = false;  ///< DXF Cad: no knot inside a curve more than once; curves are cut where there is one.
  bool arcs = false;         ///< DXF Cnc: arcs (bulges) instead of chords where they save vertices.
  DxfProfile dxf = DxfProfile::Cad;
  CurveFlavour flavour = CurveFlavour::Exact;
  std::optional<double> toleranceMm;  ///< [mm] > 0. Of what is approximated; absent: defaultTolerance().
  double strokeWidthMm = 0.1;         ///< [mm] > 0. Of the lines of SVG and PDF.
  bool widthOutlines = false;         ///< SVG: strokes as filled outlines of their width, too.
  double svgUnitsPerMm = 1.0;         ///< [1/mm] > 0. User units of an SVG (see svg_writer.h).
  double spacingMm = 1.0;             ///< [mm] > 0. Arc length between the rows of a CSV, at most.
};

/// What an approximation is allowed, [mm]: SVG and PDF 0.002, DXF laser and cubic flavours 0.005, DXF CNC 0.01.
double defaultTolerance(const ExportSettings&);
/// Whether the file holds something else than the curves themselves, so that the tolerance matters.
bool isApproximate(const ExportSettings&);

/// Whether the file holds the widths of strokes along their curves.
bool holdsWidths(const ExportSettings&);

/// Whether pieces stay together: as the settings say, else in all but DXF, IGES, STEP and 3DM.
bool isJoined(const ExportSettings&);

/// [mm] The length of one unit.
double millimetresPer(LengthUnit);
const char* nameOf(LengthUnit);  ///< "mm" or "in".

/// The endings of the names of files, with the dot, lower case; the first one is what is proposed.
std::span<const char* const> endingsOf(ExportFormat);
/// By the ending of the name, whatever its case; absent if it is none of ours. ".poly.csv" are polynomials.
std::optional<ExportFormat> formatOf(const std::filesystem::path&);
/// All endings in one line, for messages: ".svg, .json, …".
std::string allEndings();

/// Settings by purpose: who is to read the file.
struct ExportPreset {
  const char* id;     ///< What the command line calls it: "rhino".
  const char* label;  ///< "Rhino".
  const char* note;   ///< One line that says what is written and why.
  ExportSettings settings;
};
std::span<const ExportPreset> exportPresets();
/// @return nullptr if there is none of that name.
const ExportPreset* findPreset(std::string_view id);

/// Which number is out of its range, and what to do.
std::optional<Error> validate(const ExportSettings&);

}  // namespace batten
