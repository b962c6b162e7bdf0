// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/export_builder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>

#include "core/base/statistics.h"
#include "core/curve/line_names.h"
#include "core/exchange/model/export_check.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/direction_owners.h"
#include "core/pipeline/run/imported_lines.h"
#include "core/pipeline/run/piece_numbers.h"
#include "core/pipeline/run/stroke_widths.h"

namespace batten {
namespace {

/// All pieces of one contour in order of travel; null where there is no curve to export.
using ContourPieces = std::vector<const TracedCurve*>;

/// Runs of pieces that follow each other. A closed contour may be entered anywhere: it starts after a gap, so that no
/// run is cut at the contour's own start.
std::vector<std::vector<const TracedCurve*>> runs(const ContourPieces& pieces, bool closed) {
  std::vector<std::vector<const TracedCurve*>> result;
  const std::size_t n = pieces.size();
  const auto gap = std::find(pieces.begin(), pieces.end(), nullptr);
  const std::size_t start = closed && gap != pieces.end() ? gap - pieces.begin() : 0;
  bool open = false;
  for (std::size_t i = 0; i < n; ++i) {
    const TracedCurve* piece = pieces[(start + i) % n];
    if (piece != nullptr) {
      if (!open) result.emplace_back();
      result.back().push_back(piece);
    }
    open = piece != nullptr;
  }
  return result;
}

bool isWholeClosed(const std::vector<const TracedCurve*>& run, const ContourPieces& all, bool contourClosed) {
  return run.front()->closed || (contourClosed && run.size() == all.size());
}

/// The median; absent for outlines and pen strokes.
std::optional<double> strokeWidth(const Contour& line, const PageFrame& frame) {
  std::vector<float> px = strokeWidthsOf(line.points);
  if (px.empty()) return std::nullopt;
  const float middle = upperMedian(px);
  if (!(middle > 0.0f) || !std::isfinite(middle)) return std::nullopt;
  return frame.lengthToModel(static_cast<double>(middle));
}

const NurbsCurve& shapeOf(const TracedCurve& curve, bool sketched) { return sketched ? curve.sketched : curve.faired; }

/// A line that came from another file keeps its name, if Batten did not make it, and its layer. Where sketched and
/// faired curves stand in one file, the layers of the sketched ones say so: two imported layers stay apart.
void takeOrigin(const ImportedLine& line, bool sketched, bool isBoth, ExportCurve& curve) {
  curve.isImported = true;
  const std::string& name = curve.pieces.size() == 1 ? curve.pieces.front().name : line.name;
  if (!isMadeName(name)) curve.name = name;
  if (!line.layer.empty()) curve.layer = sketched && isBoth ? line.layer + " sketched" : line.layer;
}

PieceFigures figuresOf(const TracedCurve& curve, bool sketched) {
  PieceFigures figures;
  const CurveFigures& own = sketched ? curve.sketchedFigures : curve.fairedFigures;
  figures.largestOffMm = own.fromPoints.max;
  figures.typicalOffMm = own.fromPoints.rms;
  Recipe used;
  used.fairing = curve.fairingUsed;
  figures.fairing = sketched ? "none" : findParameter("fairing.mode")->get(used);
  if (sketched || curve.fairingUsed.mode == FairingMode::None) return figures;
  figures.toleranceMm = curve.fairingUsed.toleranceMm;
  figures.movedMm = curve.fairing.maxDeviationMm;
  if (curve.fairingUsed.mode == FairingMode::Target) figures.target = static_cast<int>(curve.fairingUsed.target);
  return figures;
}

/// Where pieces follow each other at a corner the stroke has one width, as each of them knows it.
void joinWidths(std::vector<ExportPiece>& pieces, bool closed) {
  const std::size_t n = pieces.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n && n > 1; ++i) {
    auto &before = pieces[i].width, &behind = pieces[(i + 1) % n].width;
    if (!before || !behind) continue;
    double &end = before->samples.back().width, &start = behind->samples.front().width;
    end = start = 0.5 * (end + start);
  }
}

/// What is exported of a run.
struct ExportedRun {
  const PipelineOutput& output;
  const Scan& scan;
  const Recipe& recipe;
  ExportedCurves which;
  ExportedWidths widths;
};

/// Adds the lines of a run in one of their two kinds.
void addCurves(const ExportedRun& exported, bool sketched, CancelCheck check, ExportDocument& document) {
  const PipelineOutput& output = exported.output;
  const Recipe& recipe = exported.recipe;
  const DirectionOwners owners = assignDirections(*output.pieces, recipe);
  StrokeWidths widths(output, exported.scan, check);
  std::map<int, ContourPieces> byContour;
  std::map<std::size_t, const TracedCurve*> byPiece;
  for (const TracedCurve& curve : output.faired->curves) {
    if (curve.included && !shapeOf(curve, sketched).isEmpty()) byPiece[curve.piece] = &curve;
  }
  for (std::size_t i = 0; i < output.pieces->pieces.size(); ++i) {
    const auto found = byPiece.find(i);
    byContour[output.pieces->pieces[i].contour].push_back(found == byPiece.end() ? nullptr : found->second);
  }
  for (const auto& [contour, pieces] : byContour) {
    if (check.isCancelled()) return;
    const Contour& line = output.contours->contours[contour];
    for (const auto& run : runs(pieces, line.closed)) {
      ExportCurve& curve = document.curves.emplace_back();
      curve.layer = sketched ? kSketchedLayer : kFairedLayer;
      curve.isSketched = sketched;
      int lowest = std::numeric_limits<int>::max();
      for (const TracedCurve* piece : run) {
        const int number = curveNumber(output, *piece);
        lowest = std::min(lowest, number);
        ExportPiece& own = curve.pieces.emplace_back(
            ExportPiece{shapeOf(*piece, sketched), nameOfCurve(output, recipe, *piece), number});
        own.figures = figuresOf(*piece, sketched);
        if (exported.widths == ExportedWidths::Measured) own.width = widths.along(*piece, shapeOf(*piece, sketched));
        if (const auto& wanted = owners.ofPiece[piece->piece])
          own.direction = PieceDirection{static_cast<int>(wanted->mark), wanted->isReversed};
      }
      if (const ImportedLine* imported = importedLineOf(line, recipe.imports))
        takeOrigin(*imported, sketched, exported.which == ExportedCurves::Both, curve);
      curve.id = lineId(lowest, sketched);
      if (const auto start = owners.startOfContour.find(contour); start != owners.startOfContour.end())
        curve.startMm = output.frame.pointToModel(recipe.starts[start->second].positionPx);
      curve.strokeWidthMm = strokeWidth(line, output.frame);
      // A loop of the drawing whose curves do not meet, because a construction breaks them, is none.
      curve.closed = isWholeClosed(run, pieces, line.closed) && isLoop(curve.pieces);
      joinWidths(curve.pieces, curve.closed);
    }
  }
}

}  // namespace

ExportDocument exportDocument(const PipelineOutput& output, const Recipe& recipe, const Scan& scan,
                              ExportedCurves which, ExportedWidths widths, CancelCheck check) {
  ExportDocument document;
  document.frame = output.frame;
  document.dpi = recipe.dpi ? recipe.dpi : scan.dpi;
  document.imageSha256 = scan.fileHash.hex();
  document.title = std::filesystem::path(scan.path).filename().string();
  if (document.title.empty() && !recipe.imports.empty()) document.title = recipe.imports.front().source;
  for (const Parameter& parameter : parameterTable())
    if (!parameter.isForDisplay) document.settings.emplace_back(parameter.name, parameter.get(recipe));
  if (!output.faired || !output.pieces || !output.contours) return document;
  const ExportedRun exported{output, scan, recipe, which, widths};
  if (which != ExportedCurves::Faired) addCurves(exported, true, check, document);
  if (which != ExportedCurves::Sketched) addCurves(exported, false, check, document);
  return document;
}

}  // namespace batten
