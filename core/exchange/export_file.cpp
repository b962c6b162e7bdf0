// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/export_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "core/base/json_text.h"
#include "core/base/number_text.h"
#include "core/base/partial_context.h"
#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/curve/curvature.h"
#include "core/curve/line_names.h"
#include "core/exchange/cad/dxf_reader.h"
#include "core/exchange/cad/dxf_writer.h"
#include "core/exchange/cad/rhino_reader.h"
#include "core/exchange/cad/rhino_writer.h"
#include "core/exchange/model/arrangement.h"
#include "core/exchange/model/cad_drawing.h"
#include "core/exchange/model/drawing_figures.h"
#include "core/exchange/model/export_check.h"
#include "core/exchange/model/read_back.h"
#include "core/exchange/occt/iges.h"
#include "core/exchange/occt/step_reader.h"
#include "core/exchange/occt/step_writer.h"
#include "core/exchange/pdf_writer.h"
#include "core/exchange/save_atomically.h"
#include "core/exchange/svg/svg_check.h"
#include "core/exchange/svg/svg_writer.h"
#include "core/exchange/text/csv_writer.h"
#include "core/exchange/text/curve_json.h"
#include "core/exchange/text/polynomial_writer.h"

namespace batten {
namespace {

constexpr double kExactMm = 1e-9;     ///< [mm at 1 m] What an exact file may differ, per size of the largest curve.
constexpr double kSizeOfExact = 1e3;  ///< [mm] Larger curves may differ by more, as their numbers do.
constexpr double kReadMargin = 1.05;  ///< An approximation is measured at other places when it is read back.

struct Check {
  std::string bytes;
  double difference = 0.0;  ///< [mm]
  double allowed = 0.0;     ///< [mm]
};

double exactTolerance(const ExportDocument& document, double scale) {
  double size = kSizeOfExact;
  for (const ExportCurve& line : document.curves) {
    for (const ExportPiece& piece : line.pieces) {
      size = std::max(size, scale * extent(piece.curve));
      for (const Vec2& p : piece.curve.controlPoints()) size = std::max(size, scale * p.cwiseAbs().maxCoeff());
    }
  }
  return kExactMm * size / kSizeOfExact;
}

double toleranceOf(const ExportSettings& settings) { return settings.toleranceMm.value_or(defaultTolerance(settings)); }

Result<std::string> cadBytes(const CadDrawing& drawing, const ExportSettings& settings, const std::string& title) {
  if (settings.format == ExportFormat::Iges) return writeIges(drawing, title);
  if (settings.format == ExportFormat::Rhino) return writeRhino(drawing);
  if (settings.format == ExportFormat::Step) return writeStep(drawing, figuresOf(drawing), title);
  return writeDxf(drawing, settings.dxf);
}

Result<CadDrawing> cadBack(const std::string& bytes, ExportFormat format) {
  if (format == ExportFormat::Iges) return readIges(bytes);
  if (format == ExportFormat::Step) return readStep(bytes);
  if (format == ExportFormat::Rhino) return readRhino(bytes);
  return readDxf(bytes);
}

/// STEP holds its curves layer by layer, in the order in which the layers come.
void sortByLayer(CadDrawing& drawing) {
  std::map<std::string, std::size_t> order;
  for (const CadEntity& entity : drawing.entities) order.try_emplace(entity.layer, order.size());
  std::stable_sort(drawing.entities.begin(), drawing.entities.end(),
                   [&](const CadEntity& a, const CadEntity& b) { return order.at(a.layer) < order.at(b.layer); });
}

Result<Check> cadFile(const ExportDocument& document, const ExportSettings& settings, const RunContext& context,
                      ExportReport& report) {
  auto made = cadExport(document, settings, context);
  if (!made) return fail(made.error());
  if (settings.format == ExportFormat::Rhino) {
    auto curves = curvesOnly(made->drawing);
    if (!curves) return fail(curves.error());
    made->drawing = std::move(*curves);
  }
  if (settings.format == ExportFormat::Step) sortByLayer(made->drawing);
  auto bytes = cadBytes(made->drawing, settings, document.title);
  if (!bytes) return fail(bytes.error());
  if (context.isCancelled()) return cancelled();
  const auto back = cadBack(*bytes, settings.format);
  if (!back && back.error().code == ErrorCode::CannotWrite) return fail(back.error());  // it was not even tried
  if (!back) return readsBackOtherwise(back.error().message);
  const auto difference = largestDifference(made->drawing, *back);
  if (!difference) return fail(difference.error());
  report.entities = static_cast<int>(made->drawing.entities.size());
  for (const CadEntity& entity : made->drawing.entities)
    if (const auto* line = std::get_if<CadPolyline>(&entity.shape))
      report.vertices += static_cast<int>(line->vertices.size());
  const bool isApproximation = isApproximate(settings);
  if (isApproximation || made->largestErrorMm > kExactMm) report.largestErrorMm = made->largestErrorMm;
  if (isApproximation && report.vertices == 0) report.largestJump = made->largestJump;
  return Check{std::move(*bytes), *difference, exactTolerance(document, settings.scale)};
}

constexpr double kWritingPart = 0.5;  ///< [-] Of the progress of an export; the rest is reading it back.

RunContext whileWriting(const RunContext& context) { return partialContext(context, 0.0, kWritingPart); }
RunContext whileReading(const RunContext& context) { return partialContext(context, kWritingPart, 1.0); }

Result<Check> svgFile(const ExportDocument& document, const ExportSettings& settings, const RunContext& context,
                      ExportReport& report) {
  auto svg = writeSvg(document,
                      {toleranceOf(settings), settings.strokeWidthMm, settings.widthOutlines, settings.svgUnitsPerMm},
                      whileWriting(context));
  if (!svg) return fail(svg.error());
  const auto back = checkSvg(svg->text, document, whileReading(context));
  if (!back) return fail(back.error());
  report.entities = back->curves;
  report.cubics = back->cubics;
  report.largestErrorMm = std::max(svg->largestErrorMm, back->largestErrorMm);
  report.largestJump = svg->largestJump;
  report.outlines = back->outlines;
  report.largestWidthErrorMm = back->largestWidthErrorMm;
  return Check{std::move(svg->text), back->largestErrorMm, kReadMargin * toleranceOf(settings)};
}

Result<Check> pdfFile(const ExportDocument& document, const ExportSettings& settings, const RunContext& context,
                      ExportReport& report) {
  auto pdf = writePdf(document, settings, whileWriting(context));
  if (!pdf) return fail(pdf.error());
  const auto difference = checkPdf(pdf->bytes, document, whileReading(context));
  if (!difference) return fail(difference.error());
  report.entities = static_cast<int>(document.curves.size());
  report.cubics = pdf->cubics;
  report.largestErrorMm = std::max(pdf->largestErrorMm, *difference);
  report.largestJump = pdf->largestJump;
  return Check{std::move(pdf->bytes), *difference, kReadMargin * toleranceOf(settings)};
}

/// Largest distance of corresponding control points and knots; the same structure is demanded.
Result<double> difference(const ExportDocument& a, const ExportDocument& b) {
  if (a.curves.size() != b.curves.size()) return readsBackOtherwise("other curves");
  double largest = 0.0;
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    if (a.curves[i].pieces.size() != b.curves[i].pieces.size()) return readsBackOtherwise("other curves");
    for (std::size_t j = 0; j < a.curves[i].pieces.size(); ++j) {
      const NurbsCurve &p = a.curves[i].pieces[j].curve, &q = b.curves[i].pieces[j].curve;
      if (p.degree() != q.degree() || p.controlPointCount() != q.controlPointCount())
        return readsBackOtherwise("other curves");
      if (a.curves[i].pieces[j].width != b.curves[i].pieces[j].width) return readsBackOtherwise("other widths");
      for (std::size_t k = 0; k < p.controlPoints().size(); ++k)
        largest = std::max(largest, (p.controlPoints()[k] - q.controlPoints()[k]).norm());
      for (std::size_t k = 0; k < p.knots().size(); ++k)
        largest = std::max(largest, std::abs(p.knots()[k] - q.knots()[k]));
    }
  }
  return largest;
}

Result<Check> jsonFile(const ExportDocument& document, const RunContext& context, ExportReport& report) {
  auto json = writeCurveJson(document, whileWriting(context));
  if (!json) return fail(json.error());
  if (json->size() > JsonLimits{}.bytes)
    return fail(ErrorCode::CannotWrite,
                "The curves would fill " + std::to_string(json->size() >> 20) + " MB of JSON, and no more than " +
                    std::to_string(JsonLimits{}.bytes >> 20) +
                    " MB can be read back: write SVG or DXF, trace a part of the page, or drop short lines "
                    "(contours.min_widths).");
  const auto back = readCurveJson(*json, whileReading(context));
  if (!back) return fail(back.error());
  const auto largest = difference(document, *back);
  if (!largest) return fail(largest.error());
  report.entities = report.pieces;
  return Check{std::move(*json), *largest, exactTolerance(document, 1.0)};
}

template <class Write, class Read>
Result<Check> tableFile(const ExportDocument& document, const ExportSettings& settings, const RunContext& context,
                        ExportReport& report, const Write& write, const Read& read) {
  auto text = write(document, settings, whileWriting(context));
  if (!text) return fail(text.error());
  const auto largest = read(*text, document, settings, whileReading(context));
  if (!largest) return fail(largest.error());
  report.entities = report.pieces;
  return Check{std::move(*text), *largest, exactTolerance(document, settings.scale)};
}

Result<Check> checkedFile(const ExportDocument& document, const ExportSettings& settings, const RunContext& context,
                          ExportReport& report) {
  switch (settings.format) {
    case ExportFormat::Svg:
      return svgFile(scaled(document, settings.scale), settings, context, report);
    case ExportFormat::Pdf:
      return pdfFile(scaled(document, settings.scale), settings, context, report);
    case ExportFormat::Json:
      return jsonFile(scaled(document, settings.scale), context, report);
    case ExportFormat::Csv:
      return tableFile(document, settings, context, report, writeCsv, checkCsv);
    case ExportFormat::Polynomials:
      return tableFile(document, settings, context, report, writePolynomials, checkPolynomials);
    default:
      return cadFile(document, settings, context, report);
  }
}

std::string shortNumber(double value) {
  std::array<char, 32> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 2).ptr;
  return {buffer.data(), end};
}

/// The numbers of a list like "1,3-5"; nothing if it is none.
std::optional<std::set<int>> numbersOf(const std::string& list) {
  std::set<int> numbers;
  std::size_t at = 0;
  const auto number = [&]() -> std::optional<int> {
    int value = 0;
    const std::size_t begin = at;
    while (at < list.size() && list[at] >= '0' && list[at] <= '9' && value < 1'000'000)
      value = 10 * value + (list[at++] - '0');
    return at > begin && value > 0 ? std::optional(value) : std::nullopt;
  };
  while (true) {
    const auto first = number();
    if (!first) return std::nullopt;
    auto last = first;
    if (at < list.size() && list[at] == '-') {
      ++at;
      last = number();
      if (!last || *last < *first) return std::nullopt;
    }
    for (int i = *first; i <= *last; ++i) numbers.insert(i);
    if (at == list.size()) return numbers;
    if (list[at++] != ',') return std::nullopt;
  }
}

}  // namespace

Result<ExportedFile> exportedFile(const ExportDocument& given, const ExportSettings& settings,
                                  const RunContext& context) {
  if (auto problem = exportProblem(given)) return fail(std::move(*problem));
  if (auto problem = validate(settings)) return fail(std::move(*problem));
  const auto made = arranged(given, isJoined(settings), context);
  if (!made) return fail(made.error());
  const ExportDocument& document = made->document;
  ExportedFile file;
  file.report.doubles = made->doubles;
  file.report.format = settings.format;
  file.report.curves = made->lines;
  for (const ExportCurve& line : document.curves) file.report.pieces += static_cast<int>(line.pieces.size());
  auto check = checkedFile(document, settings, context, file.report);
  if (!check) return fail(check.error());
  // What was not compared to the end is no difference.
  if (context.isCancelled()) return cancelled();
  if (!(check->difference <= check->allowed)) {
    return fail(ErrorCode::CannotWrite,
                "The written file deviates by " + shortNumber(check->difference) +
                    " mm when read back, more than this format allows. Nothing was saved; choose another "
                    "format.");
  }
  file.report.largestDifferenceMm = check->difference;
  file.bytes = std::move(check->bytes);
  return file;
}

Result<ExportReport> exportToFile(const ExportDocument& document, const ExportSettings& settings,
                                  const std::filesystem::path& path, const RunContext& context) {
  auto file = exportedFile(document, settings, context);
  if (!file) {
    Error error = file.error();
    if (error.code == ErrorCode::CannotWrite) error.message = shownName(path.filename()) + ": " + error.message;
    return fail(std::move(error));
  }
  if (context.isCancelled()) return cancelled();
  if (auto saved = saveAtomically(path, file->bytes); !saved) return fail(saved.error());
  const auto back = readWhole(path, file->bytes.size());
  if (!back || *back != file->bytes)
    return fail(ErrorCode::CannotWrite,
                "The file " + shownName(path) + " does not contain what was written. Is the disk full?");
  file->report.path = path;
  return std::move(file->report);
}

namespace {

/// What follows the number of curves.
std::string resultOf(const ExportReport& report) {
  std::string text;
  if (report.vertices > 0) text += " as " + counted(report.vertices, "vertex", "vertices");
  if (report.cubics > 0) text += " as " + counted(report.cubics, "cubic", "cubics");
  if (report.largestErrorMm) text += ", within " + shortNumber(*report.largestErrorMm) + " mm of the exact ones";
  constexpr double kLeastJump = 1e-5;  // below it is what rounding leaves
  if (report.largestJump.value_or(1.0) < kLeastJump) text += ", no jumps of curvature";
  if (report.largestJump.value_or(0.0) >= kLeastJump)
    text += ", curvature jumps by " + shortNumber(100.0 * *report.largestJump) + " % at most";
  if (report.outlines > 0) {
    text += ", " + counted(report.outlines, "stroke outlined within ", "strokes outlined within ") +
            shortNumber(report.largestWidthErrorMm) + " mm of " + (report.outlines == 1 ? "its" : "their") + " width";
  }
  return text + ", read back, largest difference " + shortNumber(report.largestDifferenceMm) + " mm";
}

std::string leftOut(int count, const char* one, const char* many) {
  return count > 0 ? "; " + counted(count, one, many) + " on top of another left out" : std::string();
}

}  // namespace

std::string sentenceOf(const ExportReport& report) {
  std::string text = counted(report.curves, "curve", "curves");
  if (report.pieces != report.curves) text += " in " + counted(report.pieces, "piece", "pieces");
  if (report.entities > 0 && report.entities < report.curves) text += " joined into " + std::to_string(report.entities);
  return text + resultOf(report) + leftOut(report.doubles, "piece", "pieces");
}

std::string sentenceByNumbers(const ExportReport& report) {
  std::string text = counted(report.pieces, "curve", "curves");
  if (report.entities > 0 && report.entities < report.pieces) text += " joined into " + std::to_string(report.entities);
  return text + resultOf(report) + leftOut(report.doubles, "curve", "curves");
}

namespace {

/// The number of each piece, line by line.
std::vector<std::vector<int>> pieceNumbers(const ExportDocument& document) {
  std::vector<std::vector<int>> numbers;
  int number = 0;
  for (const ExportCurve& line : document.curves) {
    auto& own = numbers.emplace_back();
    for (const ExportPiece& piece : line.pieces) own.push_back(number = piece.number.value_or(number + 1));
  }
  return numbers;
}

/// A part of a line of the drawing is called after its lowest number, as the line is; to other names a count is added.
std::string idOfPart(const ExportCurve& line, int number, int count) {
  if (line.id.starts_with(kLineIdBegin) && line.pieces.front().number) return lineId(number, line.isSketched);
  return count > 1 ? line.id + "-" + std::to_string(count) : line.id;
}

}  // namespace

ExportDocument onlyCurves(const ExportDocument& document, const std::set<int>& numbers) {
  ExportDocument result = document;
  result.curves.clear();
  const auto known = pieceNumbers(document);
  for (std::size_t i = 0; i < document.curves.size(); ++i) {
    const ExportCurve& line = document.curves[i];
    const ExportCurve bare = withoutPieces(line);
    int runs = 0, lowest = 0;
    bool continues = false;
    for (std::size_t k = 0; k < line.pieces.size(); ++k) {
      const bool isTaken = numbers.contains(known[i][k]);
      if (isTaken && !continues) {
        ExportCurve& part = result.curves.emplace_back(bare);
        ++runs;
        part.closed = false;
      }
      if (isTaken) {
        lowest = continues ? std::min(lowest, known[i][k]) : known[i][k];
        result.curves.back().id = idOfPart(line, lowest, runs);
        result.curves.back().pieces.push_back(line.pieces[k]);
      }
      continues = isTaken;
    }
    if (runs == 1 && result.curves.back().pieces.size() == line.pieces.size()) {
      result.curves.back().closed = line.closed;
      result.curves.back().id = line.id;
    }
  }
  return result;
}

Result<ExportDocument> chosenCurves(const ExportDocument& document, const std::string& list) {
  const auto numbers = numbersOf(list);
  if (!numbers) {
    return fail(ErrorCode::BadParameter, "Give curve numbers such as 1,3-5, not " + quotedText(list) + ".");
  }
  std::set<int> missing = *numbers;
  for (const auto& line : pieceNumbers(document))
    for (const int number : line) missing.erase(number);
  if (!missing.empty()) {
    return fail(ErrorCode::BadParameter, "There is no curve " + std::to_string(*missing.begin()) +
                                             " to export. The report and the window number them.");
  }
  return onlyCurves(document, *numbers);
}

}  // namespace batten
