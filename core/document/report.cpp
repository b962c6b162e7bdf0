// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/angle.h"
#include "core/base/name_text.h"
#include "core/construct/pieces.h"
#include "core/document/curve_series.h"
#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/profile/curve_comparison.h"
#include "core/fairing/target_advice.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

/// A number, or null where there is none: JSON knows no NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json pointToJson(const Vec2& p) { return {number(p.x()), number(p.y())}; }

Json deviationToJson(const Deviation& d, const PageFrame& frame) {
  const auto entry = [&](double mm) { return Json{{"px", number(frame.lengthToImage(mm))}, {"mm", number(mm)}}; };
  return {{"max", entry(d.max)},
          {"rms", entry(d.rms)},
          {"percentile_95", entry(d.percentile95)},
          {"points", d.count},
          {"worst_point_px", pointToJson(frame.pointToImage(d.worstPoint))}};
}

Json figuresToJson(const CurveFigures& f, const PageFrame& frame) {
  return {{"length_mm", number(f.lengthMm)},
          {"control_points", f.controlPoints},
          {"deviation_from_points", deviationToJson(f.fromPoints, frame)},
          {"curvature_extrema", f.extrema},
          {"inflections", f.inflections},
          {"curvature_jump_at_joints", number(f.curvatureJump)}};
}

const char* causeName(SegmentCause cause) {
  switch (cause) {
    case SegmentCause::None:
      break;
    case SegmentCause::Straight:
      return "straight";
    case SegmentCause::Inflection:
      return "inflection";
    case SegmentCause::Even:
      return "hardly changing curvature";
  }
  return "";
}

Json constructToJson(const ConstructReport& r, const PageFrame& frame) {
  Json json{{"stopped", name(r.why)},
            {"note", r.note},
            {"noise_px", number(r.noisePx)},
            {"noise_um", number(1000.0 * frame.lengthToModel(r.noisePx))},
            {"stations_added", r.stationsAdded},
            {"control_points_before_sparing", r.fullControlPoints},
            {"moved_by_sparing_px", number(r.knotRemovalMovedPx)},
            {"moved_by_sparing_um", number(1000.0 * frame.lengthToModel(r.knotRemovalMovedPx))},
            {"is_circle", r.isCircle},
            {"is_line", r.isLine},
            {"extrema", Json::array()}};
  if (r.light) {
    json["light"] = {{"found", r.light->found},
                     {"exact", r.light->exact},
                     {"control_points", r.light->points},
                     {"control_points_before", r.light->pointsBefore},
                     {"moved_px", number(r.light->movedPx)},
                     {"sections", r.light->sections},
                     {"sections_dense", r.light->sectionsDense},
                     {"why", r.light->why}};
  }
  if (r.pointsBefore > 0) {
    json["polygon_points"] = {{"before", r.pointsBefore}, {"after", r.pointsAfter}, {"added", r.pointsAdded}};
  }
  if (!r.segments.empty()) json["typical_share"] = number(typicalShare(r.segments));
  for (const SegmentNote& n : r.segments) {
    json["segments"].push_back({{"kind", n.typical ? "typical" : "transition"},
                                {"cause", causeName(n.cause)},
                                {"start_mm", pointToJson(n.startMm)},
                                {"length_mm", number(n.lengthMm)},
                                {"ratio", number(n.ratio)},
                                {"turn_deg", number(n.turnRad * kDegPerRad)},
                                {"start_curvature_per_mm", number(n.startKappa)},
                                {"end_curvature_per_mm", number(n.endKappa)},
                                {"monotone", n.typical ? Json(n.monotone) : Json(nullptr)}});
  }
  for (const ExtremumNote& e : r.extrema) {
    json["extrema"].push_back({{"s_mm", number(e.s)},
                               {"curvature_per_mm", number(e.kappa)},
                               {"maximum", e.maximum},
                               {"kept", e.kept},
                               {"removal_cost", number(e.removalCost)},
                               {"asked_cost", number(e.askedCost)},
                               {"at_px", pointToJson(frame.pointToImage(e.point))},
                               {"chosen_by_user", e.constraint.has_value()}});
  }
  json["extrema_in_turns"] = r.extremaInSharpFeatures;
  json["unmet_choices"] = r.unmetConstraints;
  return json;
}

Json logAestheticToJson(const FairingReport& r) {
  Json list = Json::array();
  for (const LogAestheticSpan& one : r.logAesthetic) {
    // Lambda is relative to the radius at the start; a span that bends both ways or is straight at an end has none.
    const bool hasLambda = one.startRadiusMm * one.endRadiusMm > 0.0;
    list.push_back({{"from", number(one.from)},
                    {"to", number(one.to)},
                    {"alpha", number(one.alpha)},
                    {"lambda", hasLambda ? number(one.lambda) : Json(nullptr)},
                    {"start_radius_mm", number(one.startRadiusMm)},
                    {"end_radius_mm", number(one.endRadiusMm)}});
  }
  return list;
}

Json fairingToJson(const FairingReport& r) {
  return {{"stopped", name(r.why)},
          {"note", r.note},
          {"iterations", r.iterations},
          {"objective_before", number(r.objectiveBefore)},
          {"objective_after", number(r.objectiveAfter)},
          {"max_deviation_mm", number(r.maxDeviationMm)},
          {"needed_mm", number(r.neededMm)},
          {"within_tolerance", r.withinTolerance},
          {"similarity_to_sketch", r.similarityAfter ? number(*r.similarityAfter) : Json()},
          {"noise_of_points_mm", number(r.noiseMm)},
          {"log_aesthetic", logAestheticToJson(r)},
          {"rounding_moved_mm", number(r.roundedMm)},
          {"curvature_extrema_before", r.extremaBefore},
          {"curvature_extrema_after", r.extremaAfter}};
}

Json targetsToJson(const TargetOutcomes& outcomes, double toleranceMm) {
  const std::optional<int> advised = advisedDegree(outcomes, toleranceMm);
  Json list = Json::array();
  for (std::size_t i = 0; i < outcomes.faired.size(); ++i) {
    const TargetProfile& p = outcomes.targets.profiles[i];
    Json json{{"degree", static_cast<int>(i) + 1},
              {"valid", p.valid},
              {"similarity", number(p.similarity)},
              {"pearson", number(p.pearson)},
              {"rms_percent", number(p.rmsPercent)},
              {"monotone", p.isMonotone},
              {"aicc", number(p.aicc)},
              {"recommended", advised == static_cast<int>(i) + 1}};
    if (!p.valid) json["problem"] = p.problem;
    if (outcomes.faired[i]) {
      json["fairing"] = fairingToJson(outcomes.faired[i]->report);
    } else if (p.valid) {
      json["problem"] = outcomes.problems[i];
    }
    list.push_back(std::move(json));
  }
  return list;
}

std::string wordOf(const FairingParams& params, const char* parameter) {
  Recipe named;
  named.fairing = params;
  return findParameter(parameter)->get(named);
}

Json choiceToJson(const TracedCurve& c) {
  return {{"included", c.included},
          {"mode", wordOf(c.fairingUsed, "fairing.mode")},
          {"target", wordOf(c.fairingUsed, "fairing.target")},
          {"drawn_profile", wordOf(c.fairingUsed, "fairing.profile")},
          {"splits", c.fairingUsed.targets.splits},
          {"keep_extrema", c.fairingUsed.keepExtrema},
          {"keep_at", c.fairingUsed.keptAt},
          {"low_pass_mm", c.fairingUsed.lowPassMm},
          {"tolerance_mm", c.fairingUsed.toleranceMm},
          {"spend", wordOf(c.fairingUsed, "fairing.spend")},
          {"moves", wordOf(c.fairingUsed, "fairing.moves")}};
}

const char* kindName(ContourKind kind) {
  if (kind == ContourKind::Pen) return "pen";
  if (kind == ContourKind::Imported) return "imported";
  return kind == ContourKind::Centreline ? "centreline" : "outline";
}

Json cornersToJson(const PipelineOutput& out, const TracedCurve& c) {
  Json list = Json::array();
  const Piece& piece = out.pieces->pieces[c.piece];
  if (piece.startIsCorner && !piece.points.empty()) list.push_back(pointToJson(piece.points.front().at));
  if (piece.endIsCorner && !piece.points.empty()) list.push_back(pointToJson(piece.points.back().at));
  return list;
}

Json curveToJson(const PipelineOutput& out, const Recipe& recipe, const ReportExtras& extras, std::size_t index) {
  const TracedCurve& c = out.faired->curves[index];
  const int known = curveNumber(out, c);
  Json json{{"index", static_cast<int>(index)},
            {"name", nameOfCurve(out, recipe, c)},
            {"number", known},
            {"contour", c.contour + 1},
            {"piece", c.piece},
            {"closed", c.closed}};
  json["kind"] = kindName(out.contours->contours[c.contour].kind);
  json["corners_px"] = cornersToJson(out, c);
  const auto& points = out.pieces->pieces[c.piece].points;
  json["points"] = points.size();
  json["points_not_placed"] = std::ranges::count(points, false, &PiecePoint::refined);
  json["sketched"] = figuresToJson(c.sketchedFigures, out.frame);
  json["construct"] = constructToJson(c.construct, out.frame);
  json["choice"] = choiceToJson(c);
  json["faired"] = figuresToJson(c.fairedFigures, out.frame);
  json["fairing"] = fairingToJson(c.fairing);
  if (extras.series) {
    json["sketched_curve"] = curveSeriesToJson(c.sketched);
    if (!(c.faired == c.sketched)) json["faired_curve"] = curveSeriesToJson(c.faired);
  }
  if (!c.included || index >= extras.targets.size()) return json;
  if (const auto& targets = extras.targets[index]) {
    json["recommended_degree"] = advisedDegree(*targets, c.fairingUsed.toleranceMm).value_or(0);
    json["targets"] = targetsToJson(*targets, c.fairingUsed.toleranceMm);
  } else {
    json["targets_problem"] = targets.error().message;
  }
  return json;
}

/// Where a line was not measured as elsewhere: points first..last of it.
Json stretchToJson(const Contour& c, int first, int last) {
  const std::vector<Vec2> at = positionsOf({c.points.begin() + first, c.points.begin() + last + 1});
  return {{"from_px", pointToJson(at.front())},
          {"to_px", pointToJson(at.back())},
          {"points", last - first + 1},
          {"length_px", number(polylineLength(at, false))}};
}

Json notPlacedToJson(const Contour& c) {
  Json list = Json::array();
  const int n = static_cast<int>(c.points.size());
  for (int i = 0; i < n; ++i) {
    if (c.points[i].refined) continue;
    int last = i;
    while (last + 1 < n && !c.points[last + 1].refined) ++last;
    list.push_back(stretchToJson(c, i, last));
    i = last;
  }
  return list;
}

/// Median and largest of some lengths along a line, and at most 65 of them at equal steps from its start to its end.
Json rangeToJson(std::vector<float> px, const PageFrame& frame) {
  if (px.empty()) return nullptr;
  Json along = Json::array();
  const std::size_t steps = std::min<std::size_t>(64, px.size() - 1);
  for (std::size_t i = 0; i <= steps; ++i) {
    along.push_back(number(static_cast<double>(px[steps == 0 ? 0 : i * (px.size() - 1) / steps])));
  }
  std::sort(px.begin(), px.end());
  const double middle = static_cast<double>(px[px.size() / 2]), most = static_cast<double>(px.back());
  return {{"median_px", number(middle)},
          {"largest_px", number(most)},
          {"median_mm", number(frame.lengthToModel(middle))},
          {"largest_mm", number(frame.lengthToModel(most))},
          {"along_px", std::move(along)}};
}

std::vector<float> halfSpread(const Contour& c) {
  std::vector<float> half;
  for (const ContourPoint& p : c.points)
    if (p.bundle) half.push_back(0.5f * (p.bundle->left + p.bundle->right));
  return half;
}

Json contourToJson(const Contour& c, std::size_t index, const PageFrame& frame) {
  const double mm2 = frame.mmPerPx * frame.mmPerPx;
  Json json{{"contour", index + 1},
            {"kind", kindName(c.kind)},
            {"closed", c.closed},
            {"hole", c.hole},
            {"kind_chosen_by_user", c.traceMode.has_value()},
            {"length_px", number(c.lengthPx)},
            {"length_mm", number(frame.lengthToModel(c.lengthPx))},
            {"area_px2", c.closed ? number(c.areaPx) : Json(nullptr)},
            {"area_mm2", c.closed ? number(c.areaPx * mm2) : Json(nullptr)},
            {"stroke_width", rangeToJson(strokeWidthsOf(c.points), frame)},
            {"merged_half_spread", rangeToJson(halfSpread(c), frame)},
            {"bridges", Json::array()},
            {"not_placed", isDrawn(c.kind) ? Json::array() : notPlacedToJson(c)}};
  const int n = static_cast<int>(c.points.size());
  for (const auto& [first, last] : c.bridges) {
    if (first >= 0 && first <= last && last < n) json["bridges"].push_back(stretchToJson(c, first, last));
  }
  return json;
}

/// More curves than this are not all compared with each other.
constexpr std::size_t kMostCompared = 60;

/// For every curve the one that is most alike (003 section 5).
void addComparisons(const PipelineOutput& out, Json& curves) {
  const auto& all = out.faired->curves;
  if (all.size() < 2 || all.size() > kMostCompared) return;
  std::vector<ShapeProfile> shapes;
  for (const TracedCurve& c : all) shapes.push_back(c.included ? shapeProfile(c.faired, c.closed) : ShapeProfile{});
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::optional<ShapeComparison> best;
    std::size_t other = 0;
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (j == i || shapes[i].radius.empty() || shapes[j].radius.empty()) continue;
      ShapeComparison found = compareShapes(shapes[i], shapes[j]);
      if (best && found.similarity <= best->similarity) continue;
      best = std::move(found);
      other = j;
    }
    if (!best) continue;
    curves[i]["most_alike"] = {{"index", static_cast<int>(other)},
                               {"name", curves[other]["name"]},
                               {"similarity", number(best->similarity)},
                               {"pearson", number(best->pearson)},
                               {"curvature_similarity", number(best->curvatureSimilarity)},
                               {"mirrored", best->mirrored},
                               {"reversed", best->reversed}};
  }
}

Json explanationToJson(const PipelineOutput& out, const Recipe& recipe, const Explanation& e) {
  Json stretches = Json::array();
  for (const InventedStretch& s : e.inventions) {
    const std::string name = nameOfCurve(out, recipe, out.faired->curves[s.curve]);
    stretches.push_back({{"curve", name}, {"from_px", pointToJson(s.fromPx)}, {"length_px", number(s.lengthPx)}});
  }
  return {{"reference_ink_px", e.referencePx}, {"explained", number(e.explained)}, {"missed", number(e.missed)},
          {"curves_px", number(e.curvesPx)},   {"invented", number(e.invented)},   {"inventions", stretches}};
}

std::size_t stationCount(const SegmentSet& set) {
  std::size_t count = 0;
  for (const PieceSegments& p : set.pieces) count += p.stations.size();
  return count;
}

/// What a stage counted, for the stages that ran.
Json countsOf(StageId stage, const PipelineOutput& out) {
  switch (stage) {
    case StageId::Thresholds:
      if (!out.thresholds) break;
      return {{"regions_measured", std::count(out.thresholds->measured.begin(), out.thresholds->measured.end(), true)},
              {"paper_noise_grey", number(out.thresholds->paperNoise)},
              {"smoothing_px", number(out.thresholds->smoothingPx)},
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
              {"junctions", out.contours->junctions.size()},
              {"doubtful_junctions", doubtfulCount(*out.contours)},
              {"refined_share", number(out.contours->report.refinedShare)},
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
  return Json::object();
}

Json stagesToJson(const PipelineOutput& out) {
  Json list = Json::array();
  for (const StageId stage : kStages) {
    const StageTiming& timing = out.timing[indexOf(stage)];
    if (!timing.run) continue;
    list.push_back({{"stage", name(stage)},
                    {"milliseconds", number(timing.milliseconds)},
                    {"from_cache", timing.fromCache},
                    {"counts", countsOf(stage, out)}});
  }
  return list;
}

}  // namespace

std::string reportToJson(const Scan& scan, const Recipe& recipe, const PipelineOutput& out,
                         const ReportExtras& extras) {
  Json json{{"format", "batten-report"}, {"version", 1}};
  const std::optional<double> dpi = recipe.dpi ? recipe.dpi : scan.dpi;
  json["image"] = {{"path", nameText(scan.path)},
                   {"format", scan.info.format},
                   {"width", scan.grey.width},
                   {"height", scan.grey.height},
                   {"dpi", dpi ? Json(*dpi) : Json(nullptr)},
                   {"scale_assumed", isScaleAssumed(scan, recipe)},
                   {"sha256", scan.fileHash.hex()}};
  json["mm_per_px"] = number(out.frame.mmPerPx);
  json["read_milliseconds"] = number(extras.readMilliseconds);
  json["stages"] = stagesToJson(out);
  if (extras.explanation) json["explanation"] = explanationToJson(out, recipe, *extras.explanation);
  Json& contours = json["contours"] = Json::array();
  for (std::size_t i = 0; out.contours && i < out.contours->contours.size(); ++i)
    contours.push_back(contourToJson(out.contours->contours[i], i, out.frame));
  Json& curves = json["curves"] = Json::array();
  for (std::size_t i = 0; out.faired && i < out.faired->curves.size(); ++i)
    curves.push_back(curveToJson(out, recipe, extras, i));
  if (out.faired) addComparisons(out, curves);
  if (curves.size() > kMostCompared) {
    json["most_alike_note"] = "Curves are compared with each other up to " + std::to_string(kMostCompared) +
                              "; there are " + std::to_string(curves.size()) + ".";
  }
  Json& failures = json["failures"] = Json::array();
  if (out.constructed) {
    for (const Error& e : out.constructed->failures) failures.push_back(e.message);
  }
  if (out.error) {
    json["error"] = {{"stage", out.failedStage ? Json(name(*out.failedStage)) : Json(nullptr)},
                     {"message", out.error->message}};
  }
  json["peak_memory_bytes"] = extras.peakMemoryBytes > 0 ? Json(extras.peakMemoryBytes) : Json(nullptr);
  // Texts of other programs may hold anything: what is not UTF-8 is replaced, never thrown over.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace batten
