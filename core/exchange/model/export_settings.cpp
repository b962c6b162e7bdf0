// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/export_settings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/base/conventions.h"

namespace batten {
namespace {

// [mm] deviation where the user names none
constexpr double kPathTolerance = 0.002, kCubicTolerance = 0.005, kChordTolerance = 0.01;
constexpr double kLeastTolerance = 1e-6;  ///< [mm] What the decimals of the files can hold.

using Endings = std::span<const char* const>;

constexpr const char* kSvg[] = {".svg"};               // endings of the format
constexpr const char* kJson[] = {".json"};             // endings of the format
constexpr const char* kDxf[] = {".dxf"};               // endings of the format
constexpr const char* kIges[] = {".igs", ".iges"};     // endings of the format
constexpr const char* kStep[] = {".stp", ".step"};     // endings of the format
constexpr const char* kPdf[] = {".pdf"};               // endings of the format
constexpr const char* kCsv[] = {".csv"};               // endings of the format
constexpr const char* kPolynomials[] = {".poly.csv"};  // endings of the format
constexpr const char* kRhino[] = {".3dm"};             // endings of the format

/// Polynomials come before CSV: their ending ends in the other's.
constexpr std::array kFormats = {ExportFormat::Svg,  ExportFormat::Json,        ExportFormat::Dxf,
                                 ExportFormat::Iges, ExportFormat::Step,        ExportFormat::Rhino,
                                 ExportFormat::Pdf,  ExportFormat::Polynomials, ExportFormat::Csv};

ExportSettings dxf(DxfProfile profile) {
  ExportSettings settings;
  settings.format = ExportFormat::Dxf;
  settings.dxf = profile;
  return settings;
}
ExportSettings cad(ExportFormat format, CurveFlavour flavour = CurveFlavour::Exact) {
  ExportSettings settings;
  settings.format = format;
  settings.flavour = flavour;
  return settings;
}
ExportSettings laser() {
  ExportSettings settings = dxf(DxfProfile::Laser);
  settings.splinesOnly = false;
  return settings;
}
ExportSettings cnc() {
  ExportSettings settings = dxf(DxfProfile::Cnc);
  settings.joined = true;
  settings.arcs = true;
  return settings;
}
ExportSettings simpleKnots() {
  ExportSettings settings = dxf(DxfProfile::Cad);
  settings.simpleKnots = true;
  return settings;
}

}  // namespace

bool isApproximate(const ExportSettings& settings) {
  switch (settings.format) {
    case ExportFormat::Svg:
    case ExportFormat::Pdf:
      return true;
    case ExportFormat::Dxf:
      return settings.dxf != DxfProfile::Cad;
    case ExportFormat::Iges:
    case ExportFormat::Step:
    case ExportFormat::Rhino:
      return settings.flavour == CurveFlavour::Cubic;
    default:
      return false;
  }
}

double defaultTolerance(const ExportSettings& settings) {
  if (settings.format == ExportFormat::Svg || settings.format == ExportFormat::Pdf) return kPathTolerance;
  if (settings.format == ExportFormat::Dxf && settings.dxf == DxfProfile::Cnc) return kChordTolerance;
  return kCubicTolerance;
}

bool holdsWidths(const ExportSettings& settings) {
  return settings.format == ExportFormat::Svg || settings.format == ExportFormat::Json;
}

bool isJoined(const ExportSettings& settings) {
  const bool isCad = settings.format == ExportFormat::Dxf || settings.format == ExportFormat::Iges ||
                     settings.format == ExportFormat::Step || settings.format == ExportFormat::Rhino;
  return settings.joined.value_or(!isCad);
}

double millimetresPer(LengthUnit unit) { return unit == LengthUnit::Inch ? kMillimetresPerInch : 1.0; }
const char* nameOf(LengthUnit unit) { return unit == LengthUnit::Inch ? "in" : "mm"; }

Endings endingsOf(ExportFormat format) {
  switch (format) {
    case ExportFormat::Svg:
      return kSvg;
    case ExportFormat::Json:
      return kJson;
    case ExportFormat::Dxf:
      return kDxf;
    case ExportFormat::Iges:
      return kIges;
    case ExportFormat::Step:
      return kStep;
    case ExportFormat::Pdf:
      return kPdf;
    case ExportFormat::Csv:
      return kCsv;
    case ExportFormat::Polynomials:
      return kPolynomials;
    case ExportFormat::Rhino:
      return kRhino;
  }
  return kSvg;
}

std::optional<ExportFormat> formatOf(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const ExportFormat format : kFormats) {
    for (const char* ending : endingsOf(format)) {
      if (name.ends_with(ending) && name != ending) return format;
    }
  }
  return std::nullopt;
}

std::string allEndings() {
  std::string text;
  for (const ExportFormat format : kFormats) {
    for (const char* ending : endingsOf(format)) text.append(text.empty() ? "" : ", ").append(ending);
  }
  return text;
}

std::span<const ExportPreset> exportPresets() {
  static const std::array presets = {
      ExportPreset{"alias", "Alias", "IGES, every curve exact, in its own degree.", cad(ExportFormat::Iges)},
      ExportPreset{"rhino", "Rhino", "STEP, every curve exact, lines and arcs as native entities.",
                   cad(ExportFormat::Step)},
      ExportPreset{"3dm", "Rhino, its own format", "3DM, every curve exact, with names and layers.",
                   cad(ExportFormat::Rhino)},
      ExportPreset{"fusion", "Fusion", "DXF, every curve one exact spline; lines, arcs and circles as such.",
                   dxf(DxfProfile::Cad)},
      ExportPreset{"catia", "CATIA", "STEP with validation properties, by which CATIA checks what it read.",
                   cad(ExportFormat::Step)},
      ExportPreset{"icem", "ICEM Surf", "IGES, each polynomial piece a Bézier curve of its own, exact.",
                   cad(ExportFormat::Iges, CurveFlavour::BezierSegments)},
      ExportPreset{"cubic", "CAD that takes degree 3 only", "IGES, curves of degree 3 within the tolerance.",
                   cad(ExportFormat::Iges, CurveFlavour::Cubic)},
      ExportPreset{"simple-knots", "CAD that takes simple knots only",
                   "DXF, exact splines, split at every multiple knot.", simpleKnots()},
      ExportPreset{"illustrator", "Illustrator", "SVG in mm: cubic paths within the tolerance, curvature kept.",
                   cad(ExportFormat::Svg)},
      ExportPreset{"inkscape", "Inkscape", "SVG in mm on a layer of its own; opens in Batten again, exact.",
                   cad(ExportFormat::Svg)},
      ExportPreset{"laser", "Laser cutter", "DXF, cubic splines, which every 2D program draws.", laser()},
      ExportPreset{"cnc", "CNC router", "DXF R12: one polyline with arcs per line of the drawing.", cnc()},
      ExportPreset{"print", "Print", "PDF, page in true size.", cad(ExportFormat::Pdf)},
      ExportPreset{"table", "Spreadsheet", "CSV: arc length, place, direction, curvature and radius.",
                   cad(ExportFormat::Csv)},
      ExportPreset{"matlab", "Matlab", "CSV of the coefficients of every polynomial piece.",
                   cad(ExportFormat::Polynomials)},
      ExportPreset{"archive", "Archive", "JSON: degree, knots and control points without any loss.",
                   cad(ExportFormat::Json)}};
  return presets;
}

const ExportPreset* findPreset(std::string_view id) {
  const auto presets = exportPresets();
  const auto found = std::find_if(presets.begin(), presets.end(), [&](const auto& preset) { return preset.id == id; });
  return found == presets.end() ? nullptr : &*found;
}

std::optional<Error> validate(const ExportSettings& settings) {
  const auto wrong = [](std::string message) { return Error{ErrorCode::BadParameter, std::move(message), {}}; };
  const auto isAbove = [](double value, double least) { return std::isfinite(value) && value > least; };
  // At the least one a drawing of a metre is as small as the places that files hold apart.
  constexpr double kLeastScale = 1e-6, kLargestScale = 1e6;
  if (!(settings.scale >= kLeastScale && settings.scale <= kLargestScale))
    return wrong("The scale of an export must be from 0.000001 to 1000000.");
  if (settings.toleranceMm && !(std::isfinite(*settings.toleranceMm) && *settings.toleranceMm >= kLeastTolerance))
    return wrong("The tolerance of an export must be at least 0.000001 mm.");
  if (!isAbove(settings.strokeWidthMm, 0.0)) return wrong("The stroke width of an export must be larger than 0 mm.");
  if (!isAbove(settings.spacingMm, 0.0)) return wrong("The spacing of the rows of a CSV must be larger than 0 mm.");
  return std::nullopt;
}

}  // namespace batten
