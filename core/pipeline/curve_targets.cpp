// SPDX-License-Identifier: GPL-3.0-or-later
#include <new>

#include "core/pipeline/pipeline.h"

namespace batten {

Result<TargetOutcomes> targetsFor(const TracedCurve& curve, const RunContext& context) {
  if (curve.sketched.isEmpty()) return fail(ErrorCode::NoCurve, "There is no curve to compare with the targets.");
  try {
    return fairAllTargets(curve.sketched, curve.closed, curve.fairingUsed, context);
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
  for (std::size_t k = 0; k < owner.size(); ++k) results[owner[k]] = std::move(outcomes[k]);
  return results;
}

}  // namespace batten
