// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report.h"

#include <algorithm>
#include <span>

#include "core/base/name_text.h"
#include "core/base/shown_text.h"
#include "core/document/report_contours.h"
#include "core/document/report_curves.h"
#include "core/document/report_values.h"

namespace batten {
namespace {

ReportJson explanationToJson(const PipelineOutput& out, const Recipe& recipe, const Explanation& e) {
  constexpr std::size_t kMostStretches = 20;  // that are listed, the longest
  ReportJson stretches = ReportJson::array();
  for (const InventedStretch& s : std::span(e.inventions).first(std::min(kMostStretches, e.inventions.size()))) {
    const std::string name = nameOfCurve(out, recipe, out.faired->curves[s.curve]);
    stretches.push_back(
        {{"curve", name}, {"from_px", pointToJson(s.linePx.front())}, {"length_px", numberToJson(s.lengthPx)}});
  }
  return {{"reference_ink_px", e.referencePx},
          {"explained", numberToJson(e.explained)},
          {"missed", numberToJson(e.missed)},
          {"curves_px", numberToJson(e.curvesPx)},
          {"invented", numberToJson(e.invented)},
          {"inventions", stretches},
          {"least_explained", numberToJson(e.leastExplained)},
          {"most_invented", numberToJson(kMostInvented)},
          {"note", e.note}};
}

std::ptrdiff_t stationCount(const SegmentSet& set) {
  std::ptrdiff_t count = 0;
  for (const PieceSegments& p : set.pieces) count += std::ssize(p.stations);
  return count;
}

/// What a stage counted, for the stages that ran.
ReportJson countsOf(StageId stage, const PipelineOutput& out) {
  switch (stage) {
    case StageId::Thresholds:
      if (!out.thresholds) break;
      return {{"regions_measured", std::count(out.thresholds->measured.begin(), out.thresholds->measured.end(), true)},
              {"paper_noise_grey", numberToJson(out.thresholds->paperNoise)},
              {"smoothing_px", numberToJson(out.thresholds->smoothingPx)},
              {"folds", out.thresholds->paper.folds.size()},
              {"note", out.thresholds->note}};
    case StageId::Binary:
      if (out.binary) return {{"ink_px", out.binary->count()}};
      break;
    case StageId::Filtered:
      if (!out.filtered) break;
      return {{"ink_px", out.filtered->report.inkAfter},
              {"lost_px", out.filtered->report.inkLost},
              {"gained_px", out.filtered->report.inkGained},
              {"undone_px", out.filtered->report.undone},
              {"iterations", out.filtered->report.iterations},
              {"stopped", name(out.filtered->report.why)},
              {"thin_strokes_lost", out.filtered->report.thinStrokesLost}};
    case StageId::Edges:
      if (out.edges) return {{"edge_px", out.edges->count()}};
      break;
    case StageId::Contours:
      if (!out.contours) break;
      return {{"contours", out.contours->contours.size()},
              {"found", out.contours->report.found},
              {"dropped_short", out.contours->report.droppedShort},
              {"dropped_holes", out.contours->report.droppedHoles},
              {"dropped_margins", out.contours->report.droppedMargins},
              {"dropped_faint", out.contours->report.droppedFaint},
              {"dropped_grain", out.contours->report.droppedGrain},
              {"junctions", out.contours->junctions.size()},
              {"doubtful_junctions", doubtfulCount(*out.contours)},
              {"refined_share", numberToJson(out.contours->report.refinedShare)},
              {"note", out.contours->report.note}};
    case StageId::Pieces:
      if (!out.pieces) break;
      return {{"pieces", out.pieces->pieces.size()},
              {"corners", out.pieces->corners.size()},
              {"corners_without_mark", unmarkedCornerCount(*out.pieces)},
              {"lost_marks", out.pieces->lostMarks.size()}};
    case StageId::Segments:
      if (out.segments) return {{"segments", stationCount(*out.segments)}};
      break;
    case StageId::Curves:
      if (!out.constructed) break;
      return {{"curves", out.constructed->curves.size()}, {"failures", out.constructed->failures.size()}};
    case StageId::Faired:
      if (out.faired) return {{"curves", out.faired->curves.size()}};
      break;
  }
  return ReportJson::object();
}

ReportJson stagesToJson(const PipelineOutput& out) {
  ReportJson list = ReportJson::array();
  for (const StageId stage : kStages) {
    const StageTiming& timing = out.timing[indexOf(stage)];
    if (!timing.run) continue;
    list.push_back({{"stage", name(stage)},
                    {"milliseconds", numberToJson(timing.milliseconds)},
                    {"from_cache", timing.fromCache},
                    {"counts", countsOf(stage, out)}});
  }
  return list;
}

}  // namespace

std::string reportToJson(const Scan& scan, const Recipe& recipe, const PipelineOutput& out,
                         const ReportExtras& extras) {
  ReportJson json{{"format", "batten-report"}, {"version", 1}};
  const std::optional<double> dpi = recipe.dpi ? recipe.dpi : scan.dpi;
  json["image"] = {{"path", nameText(scan.path)},
                   {"format", scan.info.format},
                   {"width", scan.grey.width},
                   {"height", scan.grey.height},
                   {"dpi", dpi ? ReportJson(*dpi) : ReportJson(nullptr)},
                   {"scale_assumed", isScaleAssumed(scan, recipe)},
                   {"sha256", scan.fileHash.hex()}};
  json["mm_per_px"] = numberToJson(out.frame.mmPerPx);
  json["read_milliseconds"] = numberToJson(extras.readMilliseconds);
  json["stages"] = stagesToJson(out);
  if (extras.explanation) json["explanation"] = explanationToJson(out, recipe, *extras.explanation);
  ReportJson& contours = json["contours"] = ReportJson::array();
  for (int i = 0; out.contours && i < std::ssize(out.contours->contours); ++i)
    contours.push_back(contourToJson(out.contours->contours[i], i, out.frame));
  const ReportJson& curves = json["curves"] = curvesToJson(out, recipe, extras);
  if (std::ssize(curves) > kMostCompared) {
    json["most_alike_note"] = "Curves are compared with each other up to " + std::to_string(kMostCompared) +
                              "; there are " + std::to_string(curves.size()) + ".";
  }
  ReportJson& failures = json["failures"] = ReportJson::array();
  if (out.constructed) {
    for (const Error& e : out.constructed->failures) failures.push_back(e.message);
  }
  if (out.error) {
    json["error"] = {{"stage", out.failedStage ? ReportJson(name(*out.failedStage)) : ReportJson(nullptr)},
                     {"message", out.error->message}};
  }
  json["peak_memory_bytes"] = extras.peakMemoryBytes ? ReportJson(*extras.peakMemoryBytes) : ReportJson(nullptr);
  // Texts of other programs may hold anything: what is not UTF-8 is replaced, never thrown over.
  return shownJson(json.dump(1, ' ', false, ReportJson::error_handler_t::replace)) + "\n";
}

}  // namespace batten
