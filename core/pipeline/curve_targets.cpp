// SPDX-License-Identifier: GPL-3.0-or-later
#include <new>

#include "core/pipeline/edge_length_fairing.h"
#include "core/pipeline/pipeline.h"
#include "core/pipeline/stage_items.h"

namespace batten {
namespace {

/// The outcomes of a Bezier path whose edge lengths move: what choosing each target gives.
void moveEdgeLengths(const TracedCurve& curve, TargetOutcomes& outcomes, const RunContext& context) {
  if (!movesEdgeLengths(curve.fairingUsed)) return;
  forEachItem(context, outcomes.faired.size(), [&](std::size_t i) {
    if (!outcomes.targets.profiles[i].valid) return;
    FairingParams params = curve.fairingUsed;
    params.mode = FairingMode::Target;
    params.target = static_cast<int>(i) + 1;
    auto moved = fairByEdgeLengths(curve.sketched, curve.closed, params, context);
    outcomes.problems[i] = moved ? std::string() : moved.error().message;
    outcomes.faired[i] = moved ? std::optional(std::move(*moved)) : std::nullopt;
  });
}

}  // namespace

Result<TargetOutcomes> targetsFor(const TracedCurve& curve, const RunContext& context) {
  if (curve.sketched.isEmpty()) return fail(ErrorCode::NoCurve, "There is no curve to compare with the targets.");
  try {
    auto outcomes = fairAllTargets(curve.sketched, curve.closed, curve.fairingUsed, context);
    if (outcomes) moveEdgeLengths(curve, *outcomes, context);
    if (context.isCancelled()) return cancelled();
    return outcomes;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory,
                "There is not enough memory for the six targets. Close other programs and try again.");
  }
}

std::vector<Result<TargetOutcomes>> targetsForAll(std::span<const TracedCurve> curves, const RunContext& context) {
  std::vector<TargetsJob> jobs;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (!curves[i].included || curves[i].sketched.isEmpty()) continue;
    jobs.push_back({curves[i].sketched, curves[i].closed, curves[i].fairingUsed});
    owner.push_back(i);
  }
  std::vector<Result<TargetOutcomes>> results(curves.size(), cancelled());
  auto outcomes = fairAllTargets(jobs, context);
  for (std::size_t k = 0; k < owner.size(); ++k) {
    if (outcomes[k]) moveEdgeLengths(curves[owner[k]], *outcomes[k], context);
    results[owner[k]] = std::move(outcomes[k]);
  }
  return results;
}

}  // namespace batten
