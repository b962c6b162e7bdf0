// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/curve_targets.h"

#include <new>
#include <tuple>
#include <utility>
#include <vector>

#include "core/curve/curvature.h"
#include "core/fairing/corner_sections.h"
#include "core/fairing/edge_length_fairing.h"
#include "core/fairing/fairing.h"
#include "core/pipeline/run/fairing_distance.h"
#include "core/pipeline/run/pipeline.h"
#include "core/pipeline/run/stage_items.h"

namespace batten {
namespace {

/// A curve that is asked for, and the place of its answer.
struct Asked {
  const TracedCurve* curve = nullptr;
  Result<TargetOutcomes>* outcomes = nullptr;
  std::optional<double> spanAt{};  ///< See targetsFor.
};

Result<TargetOutcomes> noMemory() {
  return fail(ErrorCode::OutOfMemory,
              "There is not enough memory for the six targets. Close other programs and try again.");
}

/// The curve that the user sees counts, not what fairing starts from.
void measureFromSeen(FairedCurve& faired, const TracedCurve& curve, int sketchedExtrema, const RunContext& context) {
  FairingReport& report = faired.report;
  report.extremaBefore = sketchedExtrema;
  if (!curve.dense) return;
  if (report.maxDeviationMm == 0.0 || faired.curve == curve.dense) {
    faired.curve = curve.sketched;
    report.extremaAfter = sketchedExtrema;
  }
  report.maxDeviationMm = movedMm(faired.curve, curve, context);
}

void moveControlPoints(const std::vector<Asked>& all, const RunContext& context) {
  std::vector<TargetsJob> jobs;
  for (const Asked& asked : all) {
    jobs.push_back({asked.curve->fairingStart(), asked.curve->closed, asked.curve->fairingUsed, asked.spanAt});
    jobs.back().params.takenMm = startsOffMm(*asked.curve, context);
  }
  auto outcomes = targetsBetweenCorners(jobs, context);
  for (std::size_t i = 0; i < all.size(); ++i) {
    *all[i].outcomes = std::move(outcomes[i]);
    if (!*all[i].outcomes) continue;
    const int sketched = countedExtrema(all[i].curve->sketched, all[i].curve->closed, context);
    for (auto& faired : (*all[i].outcomes)->faired)
      if (faired) measureFromSeen(*faired, *all[i].curve, sketched, context);
  }
}

void moveEdgeLengths(const Asked& asked, std::size_t target, const RunContext& context) {
  const TracedCurve& curve = *asked.curve;
  TargetOutcomes& outcomes = **asked.outcomes;
  try {
    const TargetProfile& profile = outcomes.targets.profiles[target];
    auto moved = fairByEdgeLengths(curve.fairingStart(), curve.closed, profile, curve.fairingUsed, context);
    if (moved)
      outcomes.faired[target] = std::move(*moved);
    else
      outcomes.problems[target] = moved.error().message;
  } catch (const std::bad_alloc&) {
    outcomes.problems[target] = noMemory().error().message;
  }
}

void moveEdgeLengths(const std::vector<Asked>& all, const RunContext& context) {
  std::vector<Asked> fitted;
  for (const Asked& asked : all) {
    const FairingParams& params = asked.curve->fairingUsed;
    if (const auto error = validate(params)) {
      *asked.outcomes = fail(*error);
      continue;
    }
    TargetOutcomes outcomes;
    outcomes.targets = fitTargets(asked.curve->fairingStart(), params.targets, asked.curve->closed);
    outcomes.recommendedDegree = outcomes.targets.recommendedDegree;
    *asked.outcomes = std::move(outcomes);
    fitted.push_back(asked);
  }
  constexpr std::size_t kTargets = std::tuple_size_v<decltype(TargetOutcomes::faired)>;  // polynomial ones
  const RunContext inner = itemContext(context, kTargets * fitted.size());
  forEachItem(context, kTargets * fitted.size(),
              [&](std::size_t i) { moveEdgeLengths(fitted[i / kTargets], i % kTargets, inner); });
}

/// What choosing each target gives, whatever the mode is now: what moves decides.
void answer(const std::vector<Asked>& all, const RunContext& context) {
  try {
    std::vector<Asked> points, edges;
    const auto asksForEdges = [](const Asked& asked) {
      return asked.curve->fairingUsed.means == FairingMeans::EdgeLengths;
    };
    for (const Asked& asked : all)
      (asksForEdges(asked) && isBezierPath(asked.curve->fairingStart()) ? edges : points).push_back(asked);
    moveControlPoints(points, context);
    for (const Asked& asked : points) {
      if (!asksForEdges(asked) || !*asked.outcomes) continue;
      for (auto& faired : (*asked.outcomes)->faired)
        if (faired) noteNoPath(faired->report);
    }
    moveEdgeLengths(edges, context);
  } catch (const std::bad_alloc&) {
    for (const Asked& asked : all) *asked.outcomes = noMemory();
  }
  if (!context.isCancelled()) return;
  for (const Asked& asked : all) *asked.outcomes = cancelled();
}

}  // namespace

Result<TargetOutcomes> targetsFor(const TracedCurve& curve, const RunContext& context, std::optional<double> spanAt) {
  if (curve.sketched.isEmpty()) return fail(ErrorCode::NoCurve, "There is no curve to compare with the targets.");
  Result<TargetOutcomes> outcomes = cancelled();
  answer({{&curve, &outcomes, spanAt}}, context);
  return outcomes;
}

std::vector<Result<TargetOutcomes>> targetsForAll(std::span<const TracedCurve> curves, const RunContext& context) {
  std::vector<Result<TargetOutcomes>> results(curves.size(), cancelled());
  std::vector<Asked> all;
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (curves[i].included && !curves[i].sketched.isEmpty()) all.push_back({&curves[i], &results[i], std::nullopt});
  answer(all, context);
  return results;
}

}  // namespace batten
