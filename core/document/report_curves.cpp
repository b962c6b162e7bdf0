// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report_curves.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/angle.h"
#include "core/construct/pieces.h"
#include "core/document/curve_series.h"
#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/profile/curve_comparison.h"
#include "core/fairing/target_advice.h"
#include "core/pipeline/recipe/parameter_table.h"

namespace batten {
namespace {

ReportJson deviationToJson(const Deviation& d, const PageFrame& frame) {
  const auto entry = [&](double mm) {
    return ReportJson{{"px", numberToJson(frame.lengthToImage(mm))}, {"mm", numberToJson(mm)}};
  };
  return {{"max", entry(d.max)},
          {"rms", entry(d.rms)},
          {"percentile_95", entry(d.percentile95)},
          {"points", d.count},
          {"worst_point_px", pointToJson(frame.pointToImage(d.worstPoint))}};
}

ReportJson figuresToJson(const CurveFigures& f, const PageFrame& frame) {
  return {{"length_mm", numberToJson(f.lengthMm)},
          {"control_points", f.controlPoints},
          {"deviation_from_points", deviationToJson(f.fromPoints, frame)},
          {"curvature_extrema", f.extrema},
          {"inflections", f.inflections},
          {"curvature_jump_at_joints", numberToJson(f.curvatureJump)}};
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

ReportJson constructToJson(const ConstructReport& r, const PageFrame& frame) {
  ReportJson json{{"stopped", name(r.why)},
                  {"note", r.note},
                  {"noise_px", numberToJson(r.noisePx.value_or(0.0))},
                  {"noise_um", numberToJson(1000.0 * frame.lengthToModel(r.noisePx.value_or(0.0)))},
                  {"stations_added", r.stationsAdded},
                  {"control_points_before_sparing", r.fullControlPoints.value_or(0)},
                  {"moved_by_sparing_px", numberToJson(r.knotRemovalMovedPx)},
                  {"moved_by_sparing_um", numberToJson(1000.0 * frame.lengthToModel(r.knotRemovalMovedPx))},
                  {"is_circle", r.isCircle},
                  {"is_line", r.isLine},
                  {"extrema", ReportJson::array()}};
  if (r.light) {
    json["light"] = {{"found", r.light->found},
                     {"exact", r.light->exact},
                     {"control_points", r.light->points},
                     {"control_points_before", r.light->pointsBefore},
                     {"moved_px", numberToJson(r.light->movedPx)},
                     {"sections", r.light->sections},
                     {"sections_dense", r.light->sectionsDense},
                     {"why", r.light->why}};
  }
  if (r.polygon) {
    json["polygon_points"] = {{"before", r.polygon->before}, {"after", r.polygon->after}, {"added", r.polygon->added}};
  }
  if (!r.segments.empty()) {
    json["typical_share"] = numberToJson(typicalShare(r.segments));
    for (const SegmentCause cause : {SegmentCause::Straight, SegmentCause::Inflection, SegmentCause::Even})
      json["transition_shares"][causeName(cause)] = numberToJson(shareOf(cause, r.segments));
  }
  for (const SegmentNote& n : r.segments) {
    json["segments"].push_back({{"kind", n.typical ? "typical" : "transition"},
                                {"cause", causeName(n.cause)},
                                {"start_mm", pointToJson(n.start)},
                                {"length_mm", numberToJson(n.length)},
                                {"ratio", numberToJson(n.ratio)},
                                {"turn_deg", numberToJson(n.turnRad * kDegPerRad)},
                                {"start_curvature_per_mm", numberToJson(n.startKappa)},
                                {"end_curvature_per_mm", numberToJson(n.endKappa)},
                                {"monotone", n.typical ? ReportJson(n.monotone) : ReportJson(nullptr)}});
  }
  for (const ExtremumNote& e : r.extrema) {
    json["extrema"].push_back({{"s_mm", numberToJson(e.s)},
                               {"curvature_per_mm", numberToJson(e.kappa)},
                               {"maximum", e.maximum},
                               {"kept", e.kept},
                               {"removal_cost", numberToJson(e.removalCost)},
                               {"asked_cost", numberToJson(e.askedCost)},
                               {"at_px", pointToJson(frame.pointToImage(e.point))},
                               {"chosen_by_user", e.constraint.has_value()}});
  }
  json["extrema_in_turns"] = r.extremaInSharpFeatures;
  json["unmet_choices"] = r.unmetConstraints;
  return json;
}

ReportJson logAestheticToJson(const FairingReport& r) {
  ReportJson list = ReportJson::array();
  for (const LogAestheticSpan& one : r.logAesthetic) {
    // Lambda is relative to the radius at the start; a span that bends both ways or is straight at an end has none.
    const double startMm = one.startRadiusMm.value_or(0.0), endMm = one.endRadiusMm.value_or(0.0);
    const bool hasLambda = startMm * endMm > 0.0;
    list.push_back({{"from", numberToJson(one.from)},
                    {"to", numberToJson(one.to)},
                    {"alpha", numberToJson(one.alpha)},
                    {"lambda", hasLambda ? numberToJson(one.lambda) : ReportJson(nullptr)},
                    {"start_radius_mm", numberToJson(startMm)},
                    {"end_radius_mm", numberToJson(endMm)}});
  }
  return list;
}

ReportJson fairingToJson(const FairingReport& r) {
  return {{"stopped", name(r.why)},
          {"note", r.note},
          {"iterations", r.iterations},
          {"objective_before", numberToJson(r.objectiveBefore)},
          {"objective_after", numberToJson(r.objectiveAfter)},
          {"max_deviation_mm", numberToJson(r.maxDeviationMm)},
          {"needed_mm", r.neededMm ? numberToJson(*r.neededMm) : ReportJson()},
          {"within_tolerance", r.withinTolerance},
          {"similarity_to_sketch", r.similarityAfter ? numberToJson(*r.similarityAfter) : ReportJson()},
          {"noise_of_points_mm", r.noiseMm ? numberToJson(*r.noiseMm) : ReportJson()},
          {"log_aesthetic", logAestheticToJson(r)},
          {"rounding_moved_mm", numberToJson(r.roundedMm)},
          {"curvature_extrema_before", r.extremaBefore},
          {"curvature_extrema_after", r.extremaAfter}};
}

ReportJson targetsToJson(const TargetOutcomes& outcomes, double toleranceMm) {
  const std::optional<int> advised = advisedDegree(outcomes, toleranceMm);
  ReportJson list = ReportJson::array();
  for (int i = 0; i < std::ssize(outcomes.faired); ++i) {
    const TargetProfile& p = outcomes.targets.profiles[i];
    ReportJson json{{"degree", i + 1},
                    {"valid", p.valid},
                    {"similarity", numberToJson(p.similarity)},
                    {"pearson", numberToJson(p.pearson)},
                    {"rms_percent", numberToJson(p.rmsPercent)},
                    {"monotone", p.isMonotone},
                    {"aicc", p.aicc ? numberToJson(*p.aicc) : ReportJson()},
                    {"recommended", advised == i + 1}};
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

ReportJson choiceToJson(const TracedCurve& c) {
  return {{"included", c.included},
          {"mode", wordOf(c.fairingUsed, "fairing.mode")},
          {"target", wordOf(c.fairingUsed, "fairing.target")},
          {"drawn_profile", wordOf(c.fairingUsed, "fairing.profile")},
          {"splits", c.fairingUsed.targets.splits},
          {"keep_extrema", numberOf(c.fairingUsed.keepExtrema)},
          {"keep_at", c.fairingUsed.keptAt},
          {"low_pass_mm", c.fairingUsed.lowPassMm},
          {"tolerance_mm", c.fairingUsed.toleranceMm},
          {"spend", wordOf(c.fairingUsed, "fairing.spend")},
          {"moves", wordOf(c.fairingUsed, "fairing.moves")}};
}

ReportJson cornersToJson(const PipelineOutput& out, const TracedCurve& c) {
  ReportJson list = ReportJson::array();
  const Piece& piece = out.pieces->pieces[c.piece];
  if (piece.startIsCorner && !piece.points.empty()) list.push_back(pointToJson(piece.points.front().at));
  if (piece.endIsCorner && !piece.points.empty()) list.push_back(pointToJson(piece.points.back().at));
  return list;
}

ReportJson curveToJson(const PipelineOutput& out, const Recipe& recipe, const ReportExtras& extras, int index) {
  const TracedCurve& c = out.faired->curves[index];
  const int known = curveNumber(out, c);
  ReportJson json{{"index", index},   {"name", nameOfCurve(out, recipe, c)},
                  {"number", known},  {"contour", c.contour + 1},
                  {"piece", c.piece}, {"closed", c.closed}};
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
  if (!c.included || index >= std::ssize(extras.targets)) return json;
  if (const auto& targets = extras.targets[index]) {
    json["recommended_degree"] = advisedDegree(*targets, c.fairingUsed.toleranceMm).value_or(0);
    json["targets"] = targetsToJson(*targets, c.fairingUsed.toleranceMm);
  } else {
    json["targets_problem"] = targets.error().message;
  }
  return json;
}

/// For every curve the one that is most alike (003 section 5).
void addComparisons(const PipelineOutput& out, ReportJson& curves) {
  const auto& all = out.faired->curves;
  if (std::ssize(all) < 2 || std::ssize(all) > kMostCompared) return;
  std::vector<ShapeProfile> shapes;
  shapes.reserve(all.size());
  for (const TracedCurve& c : all) shapes.push_back(c.included ? shapeProfile(c.faired, c.closed) : ShapeProfile{});
  for (int i = 0; i < std::ssize(all); ++i) {
    std::optional<ShapeComparison> best;
    int other = 0;
    for (int j = 0; j < std::ssize(all); ++j) {
      if (j == i || shapes[i].radius.empty() || shapes[j].radius.empty()) continue;
      ShapeComparison found = compareShapes(shapes[i], shapes[j]);
      if (best && found.similarity <= best->similarity) continue;
      best = std::move(found);
      other = j;
    }
    if (!best) continue;
    curves[i]["most_alike"] = {{"index", other},
                               {"name", curves[other]["name"]},
                               {"similarity", numberToJson(best->similarity)},
                               {"pearson", numberToJson(best->pearson)},
                               {"curvature_similarity", numberToJson(best->curvatureSimilarity)},
                               {"mirrored", best->mirrored},
                               {"reversed", best->reversed}};
  }
}

}  // namespace

ReportJson curvesToJson(const PipelineOutput& out, const Recipe& recipe, const ReportExtras& extras) {
  ReportJson curves = ReportJson::array();
  if (!out.faired) return curves;
  for (int i = 0; i < std::ssize(out.faired->curves); ++i) curves.push_back(curveToJson(out, recipe, extras, i));
  addComparisons(out, curves);
  return curves;
}

}  // namespace batten
