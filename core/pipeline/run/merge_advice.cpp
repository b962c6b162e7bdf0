// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/merge_advice.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"
#include "core/contour/merge/overdrawn_strokes.h"
#include "core/pipeline/run/pipeline.h"
#include "core/pipeline/run/stage_keys.h"

namespace batten {
namespace {

constexpr double kMostWidths = 20.0, kStepWidths = 0.5;  // of edges.merge

constexpr int kAllLines = 100000;  // contours.max_count at its largest

// Every line counts, also those that the recipe leaves out for being too many.
Recipe mergedBy(double mergeWidths, Recipe recipe) {
  recipe.edges.mergeWidths = mergeWidths;
  recipe.edges.intent = false;
  recipe.contours.maxCount = kAllLines;
  return recipe;
}

int centrelinesOf(const ContourSet& set) {
  return static_cast<int>(std::count_if(set.contours.begin(), set.contours.end(),
                                        [](const Contour& c) { return c.kind == ContourKind::Centreline; }));
}

Recipe grouped(Recipe recipe) {
  recipe = mergedBy(0.0, std::move(recipe));
  recipe.edges.intent = true;
  return recipe;
}

Result<std::shared_ptr<const ContourSet>> linesWith(const Recipe& recipe, const Scan& scan, StageCache& cache,
                                                    const RunContext& context) {
  PipelineRequest request;
  request.upTo = StageId::Contours;
  request.needEdges = false;
  PipelineOutput output = runPipeline(scan, recipe, cache, request, context);
  if (context.isCancelled()) return cancelled();
  if (output.error) return fail(std::move(*output.error));
  return output.contours;
}

}  // namespace

Result<MergeAdvice> adviseMerge(const Scan& scan, const Recipe& recipe, StageCache& cache, const RunContext& context) {
  const auto apart = linesWith(mergedBy(0.0, recipe), scan, cache, context);
  if (!apart) return fail(apart.error());
  MergeAdvice advice;
  advice.strokes = advice.lines = centrelinesOf(**apart);
  if (advice.strokes == 0 || !(*apart)->report.widthPx) return advice;
  const double width = *(*apart)->report.widthPx;
  const auto meant = linesWith(grouped(recipe), scan, cache, context);
  if (!meant) return fail(meant.error());
  if ((*meant)->report.isGrouped) advice.meant = centrelinesOf(**meant);
  const std::optional<OverdrawnStrokes> strokes =
      findOverdrawnStrokes((*apart)->contours, (kMostWidths + 1.0) * width, context);
  if (context.isCancelled()) return cancelled();
  if (!strokes) return advice;
  // The distance is between middles: a width more than the paper between.
  const double widths = kStepWidths * std::round((strokes->distancePx / width - 1.0) / kStepWidths);
  const double strength = std::clamp(widths, kStepWidths, kMostWidths);
  const auto merged = linesWith(mergedBy(strength, recipe), scan, cache, context);
  if (!merged) return fail(merged.error());
  advice.share = strokes->share;
  if (centrelinesOf(**merged) >= advice.strokes) return advice;
  advice.widths = strength;
  advice.lines = centrelinesOf(**merged);
  return advice;
}

ContentHash mergeAdviceKey(const Scan& scan, const Recipe& recipe) {
  return stageKeys(scan, mergedBy(0.0, recipe), {})[StageId::Contours];
}

std::string describe(const MergeAdvice& advice) {
  if (advice.strokes == 0) return "No centre lines are traced, so there are no strokes to merge.";
  const std::string meant = advice.meant
                                ? " With edges.intent there " + std::string(*advice.meant == 1 ? "is " : "are ") +
                                      counted(*advice.meant, "curve.", "curves.")
                                : std::string();
  if (!advice.widths && advice.share > 0.0)
    return "Some strokes overlap, but merging them would not reduce the number of lines." + meant;
  if (!advice.widths) return "No overdrawn strokes were found." + meant;
  return numberToText(*advice.widths) + (*advice.widths == 1.0 ? " stroke width: " : " stroke widths: ") +
         counted(advice.strokes, "stroke becomes ", "strokes become ") + counted(advice.lines, "line.", "lines.") +
         meant;
}

}  // namespace batten
