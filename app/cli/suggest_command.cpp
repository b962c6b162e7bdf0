// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/suggest_command.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/exit_codes.h"
#include "app/cli/recipe_arguments.h"
#include "app/cli/shown_digits.h"
#include "app/cli/trace_plan.h"
#include "core/base/angle.h"
#include "core/base/json_text.h"
#include "core/base/name_text.h"
#include "core/base/platform.h"
#include "core/contour/corner/corner_certainty.h"
#include "core/image/file/scan_reader.h"
#include "core/pipeline/run/corner_places.h"
#include "core/pipeline/run/merge_advice.h"

namespace batten::cli {
namespace {

struct Advice {
  std::optional<SheetView> sheet;  ///< Seen at an angle.
  std::vector<std::string> notes;  ///< On what was not looked at.
  MergeAdvice merge;
  std::vector<CornerSuggestion> corners;
  std::vector<StrokeJunction> junctions;
};

nlohmann::ordered_json cornersToJson(const std::vector<CornerSuggestion>& corners) {
  auto list = nlohmann::ordered_json::array();
  for (const CornerSuggestion& corner : corners) {
    list.push_back({{"at", {withDecimals(corner.positionPx.x(), 2), withDecimals(corner.positionPx.y(), 2)}},
                    {"angle", withDecimals(std::abs(corner.turningAngleRad) * kDegPerRad, 1)},
                    {"certainty", withDecimals(corner.certainty, 3)},
                    {"certain", corner.certainty >= kCertainCorner}});
  }
  return list;
}

nlohmann::ordered_json pairsToJson(const EndPairs& pairs) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& [a, b] : pairs) list.push_back({a, b});
  return list;
}

nlohmann::ordered_json placeToJson(const Vec2& px) { return {withDecimals(px.x(), 2), withDecimals(px.y(), 2)}; }

nlohmann::ordered_json junctionsToJson(const std::vector<StrokeJunction>& junctions) {
  auto list = nlohmann::ordered_json::array();
  for (const StrokeJunction& junction : junctions) {
    if (!junction.isDoubtful || junction.choice || junction.pairings.size() < 2) continue;
    auto branches = nlohmann::ordered_json::array();
    for (const Vec2& place : junction.branchesPx) branches.push_back(placeToJson(place));
    list.push_back({{"at", placeToJson(junction.positionPx)},
                    {"branches", std::move(branches)},
                    {"pairs", pairsToJson(junction.pairs)},
                    {"next_best", pairsToJson(junction.pairings[1])}});
  }
  return list;
}

nlohmann::ordered_json sheetToJson(const std::optional<SheetView>& view) {
  if (!view) return nullptr;
  auto corners = nlohmann::ordered_json::array();
  for (const Vec2& corner : view->rectification.cornersPx) corners.push_back(placeToJson(corner));
  return {{"corners", std::move(corners)},
          {"skew", withDecimals(view->skewDeg, 2)},
          {"convergence", withDecimals(view->convergenceDeg, 2)},
          {"aspect", withDecimals(view->rectification.aspect, 4)},
          {"aspect_error", withDecimals(view->rectification.aspectError, 4)}};
}

/// The lines as the recipe traces them.
Result<PipelineOutput> linesOf(const Scan& scan, const Recipe& recipe, StageCache& cache, const RunContext& context) {
  PipelineRequest request;
  request.upTo = StageId::Contours;
  request.needEdges = false;
  PipelineOutput out = runPipeline(scan, recipe, cache, request, context);
  if (!out.contours) return out.error ? fail(*out.error) : fail(ErrorCode::NoCurve, "No line was found.");
  return out;
}

Result<Advice> adviceFor(const TraceArguments& arguments) {
  if (arguments.scan.empty()) return fail(ErrorCode::BadParameter, "Name a scan.");
  const auto recipe = recipeOf(arguments);
  if (!recipe) return fail(recipe.error());
  RunContext context;
  const auto threads = threadsOf(arguments);
  if (!threads) return fail(threads.error());
  context.threads = *threads;
  auto scan = [&] {
    const QuietStderr quiet;
    return readScan(arguments.scan, {.page = recipe->scanPage}, context);
  }();
  if (!scan) return fail(scan.error());
  scan = rectified(std::move(*scan), recipe->preparation.rectify, context);
  if (!scan) return fail(scan.error());
  StageCache cache;
  auto merge = adviseMerge(*scan, *recipe, cache, context);
  if (!merge) return fail(merge.error());
  const auto lines = linesOf(*scan, *recipe, cache, context);
  if (!lines) return fail(lines.error());
  Advice advice{
      lines->page->view, {}, std::move(*merge), possibleCorners(*lines->contours, context), lines->contours->junctions};
  if (const auto note = otherPagesNote(arguments, *recipe, *scan)) advice.notes.push_back(*note);
  if (!scan->rectifyNote.empty()) advice.notes.push_back(scan->rectifyNote);
  return advice;
}

}  // namespace

int runSuggest(const TraceArguments& given) {
  TraceArguments arguments = given;
  arguments.takesAllPages = false;
  const auto advice = adviceFor(arguments);
  if (!advice) return reportError(advice.error());
  nlohmann::ordered_json json{
      {"scan", nameText(arguments.scan)},
      {"edges.merge", withDecimals(advice->merge.widths.value_or(0.0), 3)},
      {"edges.intent", advice->merge.meant.has_value()},
      {"strokes", advice->merge.strokes},
      {"lines", advice->merge.lines},
      {"curves_meant", advice->merge.meant ? nlohmann::ordered_json(*advice->merge.meant) : nlohmann::ordered_json()},
      {"overdrawn_share", withDecimals(advice->merge.share, 4)},
      {"reason", describe(advice->merge)},
      {"corners", cornersToJson(advice->corners)},
      {"doubtful_junctions", junctionsToJson(advice->junctions)},
      {"rectify", sheetToJson(advice->sheet)},
      {"notes", advice->notes}};
  std::cout << jsonLine(json) << '\n';
  return endOutput();
}

}  // namespace batten::cli
