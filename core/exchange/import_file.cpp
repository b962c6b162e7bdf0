// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/import_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <set>

#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/curve/import_limits.h"
#include "core/exchange/cad/dxf_reader.h"
#include "core/exchange/cad/iges_reader.h"
#include "core/exchange/cad/step_reader.h"
#include "core/exchange/import_lines.h"
#include "core/exchange/point_file.h"
#include "core/exchange/svg/own_svg.h"
#include "core/exchange/svg/svg_reader.h"
#include "core/exchange/svg/svg_shapes.h"
#include "core/exchange/text/curve_json.h"

namespace batten {
namespace {

constexpr std::uint64_t kLargestImportBytes = std::uint64_t{64} << 20;  // limit of input
// as they are listed in messages
constexpr std::array<const char*, 9> kImportEndings = {".dxf", ".igs", ".iges", ".stp", ".step",
                                                       ".svg", ".csv", ".txt",  ".json"};

std::string importEndingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::string unitName(double mmPerUnit) {
  if (mmPerUnit == 1.0) return "mm";
  if (mmPerUnit == 10.0) return "cm";
  if (mmPerUnit == 1000.0) return "m";
  if (mmPerUnit == kMillimetresPerInch) return "in";
  if (mmPerUnit == 12.0 * kMillimetresPerInch) return "ft";
  return numberToText(mmPerUnit) + " mm";
}

/// Sets the unit; what was assumed is said.
double takeUnit(std::optional<double> stated, std::optional<double> asked, ImportReport& report) {
  const double mm = asked.value_or(stated.value_or(1.0));
  report.file.unit = unitName(mm) + (asked || stated ? "" : "?");
  if (!asked && !stated) report.notes.push_back("The file " + report.file.source + " states no unit; mm were assumed.");
  return mm;
}

void tellLeft(int left, ImportReport& report) {
  report.skipped += left;
  if (left == 0) return;
  report.notes.push_back(
      counted(left, "entity of ", "entities of ") + report.file.source +
      (left == 1 ? " could not be imported and was skipped." : " could not be imported and were skipped."));
}

void takeDrawing(const CadDrawing& drawing, std::optional<double> asked, ImportReport& report) {
  DrawingLines drawn = linesOf(drawing, takeUnit(drawing.mmPerUnit, asked, report));
  report.file.lines = std::move(drawn.lines);
  tellLeft(drawing.left + drawn.left, report);
}

/// Scales all lines about the origin.
void scaleLines(double factor, ImportedFile& file) {
  for (ImportedLine& line : file.lines) {
    for (auto& [curve, name] : line.curves) curve = curve.mapped(factor * Eigen::Matrix2d::Identity(), Vec2::Zero());
    for (Vec2& p : line.points) p *= factor;
  }
}

/// Lines that were read in mm: the user's unit, if there is one, takes the place of the file's own.
void takeUnitOf(double mmPerUnit, std::optional<double> asked, ImportReport& report) {
  if (!asked) return;
  scaleLines(*asked / mmPerUnit, report.file);
  report.file.unit = unitName(*asked);
}

void takePoints(PointFile points, std::optional<double> asked, ImportReport& report) {
  const double mm = takeUnit(points.mmPerUnit, asked, report);
  report.file.lines = std::move(points.lines);
  report.parts = std::move(points.parts);
  for (const std::string& note : points.notes) report.notes.push_back(report.file.source + ": " + note + ".");
  // Where a file names the parts of a line, it has no corners but those between them.
  std::set<std::size_t> linesWithParts;
  for (const NamedPart& part : report.parts) linesWithParts.insert(part.line);
  const auto hasParts = [&](const ImportedLine& line) {
    return linesWithParts.contains(&line - report.file.lines.data());
  };
  for (ImportedLine& line : report.file.lines) {
    for (Vec2& p : line.points) p *= mm;
    const auto last = std::unique(line.points.begin(), line.points.end());
    line.points.erase(last, line.points.end());
    if (std::ssize(line.points) < 3) line.closed = false;
    if (line.points.size() >= 2 && line.corners.empty() && !hasParts(line)) findCorners(line);
  }
  const auto erased = std::erase_if(
      report.file.lines, [](const ImportedLine& line) { return line.curves.empty() && line.points.size() < 2; });
  tellLeft(points.left + static_cast<int>(erased), report);
}

/// The exact curves of one of Batten's own SVG files where its paths still show them, else the paths.
void takeOwnSvg(const ExportDocument& own, SvgShapes shapes, double toleranceMm, ImportReport& report) {
  const Vec2 origin(own.frame.leftMm, own.frame.bottomMm);
  for (ImportedLine& line : shapes.lines) {
    for (auto& [curve, name] : line.curves) curve = curve.mapped(Eigen::Matrix2d::Identity(), origin);
  }
  OwnSvgLines lines = exactWhereUnchanged(linesOf(own), std::move(shapes.lines), toleranceMm);
  report.file.unit = "mm";
  report.file.lines = std::move(lines.lines);
  if (lines.drawn > 0) {
    report.notes.push_back(report.file.source + ": " +
                           counted(lines.drawn, "path was changed by another program and was read as drawn.",
                                   "paths were changed by another program and were read as drawn."));
  }
  if (lines.gone > 0) {
    report.notes.push_back(report.file.source + ": " +
                           counted(lines.gone, "curve written by Batten is no longer drawn and was skipped.",
                                   "curves written by Batten are no longer drawn and were skipped."));
  }
}

Result<void> takeSvg(const std::string& bytes, std::optional<double> asked, const RunContext& context,
                     ImportReport& report) {
  auto shapes = readSvgShapes(bytes, context);
  if (!shapes) return fail(shapes.error());
  if (bytes.find("urn:batten:curves") != std::string::npos) {
    if (const auto own = readSvg(bytes)) {
      tellLeft(shapes->left, report);
      takeOwnSvg(*own, std::move(*shapes), statedPathTolerance(bytes), report);
      takeUnitOf(1.0, asked, report);
      return {};
    }
    report.notes.push_back("The exact curves of Batten are no longer in " + report.file.source +
                           ", or cannot be read; its paths were read as drawn.");
  }
  report.file.lines = std::move(shapes->lines);
  report.file.unit = shapes->hasSize ? "mm" : "px?";
  if (!shapes->hasSize && !asked)
    report.notes.push_back("The file " + report.file.source + " states no size; 96 units per inch were assumed.");
  takeUnitOf(shapes->mmPerUnit, asked, report);
  tellLeft(shapes->left, report);
  return {};
}

Result<void> takeJson(const std::string& bytes, std::optional<double> asked, const RunContext& context,
                      ImportReport& report) {
  if (bytes.find("\"batten-curves\"") != std::string::npos) {
    const auto own = readCurveJson(bytes, context);
    if (!own) return fail(own.error());
    report.file.lines = linesOf(*own);
    report.file.unit = "mm";
    takeUnitOf(1.0, asked, report);
    return {};
  }
  auto points = readPointJson(bytes, context);
  if (!points) return fail(points.error());
  takePoints(std::move(*points), asked, report);
  return {};
}

Result<void> takeBytes(const std::string& ending, const std::string& bytes, std::optional<double> asked,
                       const RunContext& context, ImportReport& report) {
  if (ending == ".svg") return takeSvg(bytes, asked, context, report);
  if (ending == ".json") return takeJson(bytes, asked, context, report);
  if (ending == ".csv" || ending == ".txt") {
    auto points = readPointTable(bytes, context);
    if (!points) return fail(points.error());
    takePoints(std::move(*points), asked, report);
    return {};
  }
  const auto drawing = ending == ".dxf"                        ? readDxf(bytes)
                       : ending == ".igs" || ending == ".iges" ? parseIges(bytes, context)
                                                               : parseStep(bytes, context);
  if (!drawing) return fail(drawing.error());
  takeDrawing(*drawing, asked, report);
  return {};
}

/// Names as windows and other files can hold them, whatever bytes the file has.
void makeNamesShown(ImportedLine& line) {
  const auto shown = [](std::string& name) { name = shownText(trimmed(name)); };
  shown(line.name);
  shown(line.layer);
  for (ImportedCurve& curve : line.curves) shown(curve.name);
}

Result<void> checkSharpTurns(const ImportedFile& file) {
  std::size_t turns = 0;
  for (const ImportedLine& line : file.lines) turns += sharpTurnsOf(line);
  if (auto wrong = tooManySharpTurns(turns)) return fail(*wrong);
  return {};
}

}  // namespace

bool isImportName(const std::filesystem::path& path) {
  const std::string ending = importEndingOf(path);
  return std::find(kImportEndings.begin(), kImportEndings.end(), ending) != kImportEndings.end();
}

std::string importEndings() {
  std::string all;
  for (const char* ending : kImportEndings) all.append(all.empty() ? "" : ", ").append(ending);
  return all;
}

Result<ImportReport> readImportFile(const std::filesystem::path& path, std::optional<double> mmPerUnit,
                                    const RunContext& context) {
  const std::string name = shownName(path.filename());
  if (!isImportName(path)) {
    return fail(ErrorCode::BadParameter,
                "Curves are not read from " + name + ". Take a file that ends in one of " + importEndings() + ".");
  }
  const auto bytes = readWhole(path, kLargestImportBytes);
  if (!bytes) {
    return fail(ErrorCode::BadParameter, "The curves " + shownName(path) + " cannot be read: the file " +
                                             describe(bytes.error()) + ". Check the name.");
  }
  ImportReport report;
  report.file.source = name;
  auto taken = takeBytes(importEndingOf(path), *bytes, mmPerUnit, context, report);
  for (ImportedLine& line : report.file.lines) makeNamesShown(line);
  for (NamedPart& part : report.parts) part.name = shownText(trimmed(part.name));
  if (taken && report.file.lines.empty())
    taken = report.skipped == 0 ? fail(ErrorCode::NoCurve, "It contains no line.")
                                : fail(ErrorCode::BadParameter, "None of its lines could be read: it is damaged.");
  if (taken) {
    if (auto wrong = validate(report.file)) taken = fail(std::move(*wrong));
  }
  if (taken) taken = checkSharpTurns(report.file);
  if (!taken && taken.error().code == ErrorCode::Cancelled) return cancelled();
  if (!taken) return fail(taken.error().code, name + ": " + taken.error().message, taken.error().detail);
  return report;
}

}  // namespace batten
