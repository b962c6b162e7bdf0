// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/import_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <set>

#include "core/base/angle.h"
#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/cad/dxf_reader.h"
#include "core/exchange/cad/iges_reader.h"
#include "core/exchange/cad/step_reader.h"
#include "core/exchange/model/cad_shape.h"
#include "core/exchange/point_file.h"
#include "core/exchange/svg/own_svg.h"
#include "core/exchange/svg/svg_reader.h"
#include "core/exchange/svg/svg_shapes.h"
#include "core/exchange/text/curve_json.h"

namespace batten {
namespace {

constexpr std::uint64_t kLargestImportBytes = std::uint64_t{64} << 20;
constexpr std::array<const char*, 9> kImportEndings = {".dxf", ".igs", ".iges", ".stp", ".step",
                                                       ".svg", ".csv", ".txt",  ".json"};
constexpr double kSharpTurn = 35.0 * kRadPerDeg;
/// Polylines of no more points are drawn corner by corner; of longer ones a corner has to stand out from its
/// neighbours.
constexpr std::ptrdiff_t kFewPoints = 16;

std::string importEndingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// The points of a polyline at which it turns sharply.
std::vector<int> sharpPoints(const std::vector<Vec2>& points, bool closed) {
  const std::ptrdiff_t n = std::ssize(points);
  std::vector<double> turns(points.size(), 0.0);
  for (std::ptrdiff_t i = closed ? 0 : 1; i < (closed ? n : n - 1); ++i) {
    const Vec2 in = points[i] - points[(i + n - 1) % n];
    const Vec2 out = points[(i + 1) % n] - points[i];
    turns[i] = std::abs(std::atan2(cross(in, out), in.dot(out)));
  }
  std::vector<int> corners;
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double turn = turns[i];
    const double beside = std::max(turns[(i + n - 1) % n], turns[(i + 1) % n]);
    if (turn >= kSharpTurn && (n <= kFewPoints || turn >= 2.0 * beside)) corners.push_back(static_cast<int>(i));
  }
  return corners;
}

/// DXF puts what has no layer on layer 0.
std::string layerOf(const CadEntity& entity) { return entity.layer == "0" ? std::string() : entity.layer; }

void setCorners(ImportedLine& line) { line.corners = sharpPoints(line.points, line.closed); }

/// Makes lines of the entities of a drawing, one after the other.
class LineBuilder {
 public:
  explicit LineBuilder(double mmPerUnit) : linear_(mmPerUnit * Eigen::Matrix2d::Identity()) {}

  void add(const CadEntity& entity) {
    if (const auto* polyline = std::get_if<CadPolyline>(&entity.shape); polyline != nullptr && isOfChords(*polyline)) {
      endLine();
      addPoints(*polyline, entity);
      return;
    }
    if (const auto* polyline = std::get_if<CadPolyline>(&entity.shape); polyline != nullptr && hasArcs(*polyline)) {
      addEdges(*polyline, entity);
      return;
    }
    const auto curve = curveOf(entity.shape);
    const auto held = curve ? clamped(*curve) : Result<NurbsCurve>(tl::unexpected(curve.error()));
    if (!held) {
      ++left_;
      return;
    }
    const NurbsCurve shape = held->mapped(linear_, Vec2::Zero());
    const bool mayTurn = std::holds_alternative<CadArc>(entity.shape);  // an arc has no direction of its own
    if (!continues({shape, entity.name}, mayTurn, layerOf(entity))) {
      endLine();
      line_.name = entity.name;
      line_.layer = layerOf(entity);
      line_.curves = {{shape, entity.name}};
      firstMayTurn_ = mayTurn;
    }
    if (meet(line_.curves.back().curve, line_.curves.front().curve)) {
      line_.closed = true;
      endLine();
    }
  }
  std::vector<ImportedLine> take() {
    endLine();
    return std::move(lines_);
  }
  int left() const { return left_; }

 private:
  static bool isOfChords(const CadPolyline& line) {
    return line.vertices.size() > 2 &&
           std::all_of(line.vertices.begin(), line.vertices.end(), [](const CadVertex& v) { return v.bulge == 0.0; });
  }
  void addPoints(const CadPolyline& polyline, const CadEntity& entity) {
    ImportedLine line;
    line.name = entity.name;
    line.layer = layerOf(entity);
    line.closed = polyline.closed;
    for (const CadVertex& v : polyline.vertices) {
      const Vec2 at = linear_ * v.point;
      if (line.points.empty() || line.points.back() != at) line.points.push_back(at);
    }
    if (line.points.size() > 3 && line.points.front() == line.points.back()) {
      line.points.pop_back();
      line.closed = true;
    }
    if (line.points.size() < 3) line.closed = false;
    if (line.points.size() < 2) {
      ++left_;
      return;
    }
    setCorners(line);
    lines_.push_back(std::move(line));
  }

  static bool hasArcs(const CadPolyline& line) {
    return line.vertices.size() > 1 &&
           std::any_of(line.vertices.begin(), line.vertices.end(), [](const CadVertex& v) { return v.bulge != 0.0; });
  }
  /// A polyline with arcs: a line of its own, with a corner at each vertex, where a line or an arc ends.
  void addEdges(const CadPolyline& polyline, const CadEntity& entity) {
    endLine();
    const auto edges = edgesOf(polyline);
    if (!edges || edges->empty()) {
      ++left_;
      return;
    }
    line_.name = entity.name;
    line_.layer = layerOf(entity);
    for (const NurbsCurve& edge : *edges) line_.curves.push_back({edge.mapped(linear_, Vec2::Zero())});
    line_.closed = polyline.closed || meet(line_.curves.back().curve, line_.curves.front().curve);
    endLine();
  }

  static double sizeOf(const NurbsCurve& curve) {
    double size = 0.0;
    for (const Vec2& p : curve.controlPoints()) size = std::max(size, (p - curve.controlPoints().front()).norm());
    return size;
  }
  static bool isSamePlace(const Vec2& a, const Vec2& b, const NurbsCurve& one, const NurbsCurve& other) {
    constexpr double kSame = 1e-7;  // of the size of the larger one
    return (a - b).norm() <= kSame * std::max(sizeOf(one), sizeOf(other));
  }
  static bool meet(const NurbsCurve& before, const NurbsCurve& behind) {
    return isSamePlace(before.controlPoints().back(), behind.controlPoints().front(), before, behind);
  }

  /// Adds the curve to the line if it begins where that one ends.
  bool continues(const ImportedCurve& next, bool mayTurn, const std::string& layer) {
    if (line_.curves.empty() || layer != line_.layer) return false;
    const NurbsCurve &last = line_.curves.back().curve, &curve = next.curve;
    const bool isFirst = line_.curves.size() == 1 && firstMayTurn_;
    const std::array<NurbsCurve, 2> lasts{last, isFirst ? reversed(last) : NurbsCurve()};
    const std::array<NurbsCurve, 2> nexts{curve, mayTurn ? reversed(curve) : NurbsCurve()};
    for (const NurbsCurve& before : lasts) {
      for (const NurbsCurve& behind : nexts) {
        if (before.isEmpty() || behind.isEmpty() || !meet(before, behind)) continue;
        line_.curves.back().curve = before;
        line_.curves.push_back({behind, next.name});
        return true;
      }
    }
    return false;
  }
  void endLine() {
    if (!line_.curves.empty()) lines_.push_back(std::move(line_));
    line_ = {};
  }

  Eigen::Matrix2d linear_;
  std::vector<ImportedLine> lines_;
  ImportedLine line_;
  bool firstMayTurn_ = false;
  int left_ = 0;
};

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
      std::to_string(left) + (left == 1 ? " entity of " : " entities of ") + report.file.source +
      (left == 1 ? " could not be imported and was skipped." : " could not be imported and were skipped."));
}

void takeDrawing(const CadDrawing& drawing, std::optional<double> asked, ImportReport& report) {
  LineBuilder builder(takeUnit(drawing.mmPerUnit, asked, report));
  for (const CadEntity& entity : drawing.entities) builder.add(entity);
  report.file.lines = builder.take();
  tellLeft(drawing.left + builder.left(), report);
}

/// Lines of Batten's own files; where the curves of one leave a gap it becomes two.
std::vector<ImportedLine> linesOf(const ExportDocument& document) {
  std::vector<ImportedLine> lines;
  for (const ExportCurve& curve : document.curves) {
    ImportedLine line;
    line.name = curve.name;
    line.layer = curve.layer;
    line.closed = curve.closed;
    for (const ExportPiece& piece : curve.pieces) {
      const auto held = clamped(piece.curve);
      if (!held) continue;
      const bool isApart =
          !line.curves.empty() &&
          !(line.curves.back().curve.controlPoints().back() - held->controlPoints().front()).isZero(1e-9);
      if (isApart) {
        line.closed = false;
        lines.push_back(line);
        line.curves.clear();
      }
      line.curves.push_back({*held, piece.name});
    }
    if (!line.curves.empty()) lines.push_back(std::move(line));
  }
  return lines;
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
    if (line.corners.empty() && !hasParts(line)) setCorners(line);
  }
  const auto erased = std::erase_if(report.file.lines, [](const ImportedLine& line) { return line.points.size() < 2; });
  tellLeft(points.left + static_cast<int>(erased), report);
}

std::string counted(int count, const char* one, const char* more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
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
  if (!taken && taken.error().code == ErrorCode::Cancelled) return cancelled();
  if (!taken) return fail(taken.error().code, name + ": " + taken.error().message, taken.error().detail);
  return report;
}

}  // namespace batten
