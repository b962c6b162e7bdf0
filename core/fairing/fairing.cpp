// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/fairing.h"

#include <algorithm>
#include <new>
#include <numeric>

#include "core/base/parallel.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_line.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/polynomial_fairing.h"
#include "core/fairing/profile/target_degrees.h"
#include "core/fairing/recommended_degree.h"
#include "core/fairing/structure/fair_as_needed.h"
#include "core/fairing/structure/monotone_fairing.h"
#include "core/fairing/structure/tolerance_fairing.h"
#include "core/fairing/target/low_pass.h"
#include "core/fairing/target/natural_spans.h"
#include "core/fairing/target/shape_modification.h"
#include "core/fairing/target/span_fairing.h"
#include "core/fairing/target_levels.h"
#include "core/fairing/target_splits.h"

namespace batten {
namespace {

/// The targets of one curve, on the way.
struct TargetsRun {
  std::shared_ptr<const FairingSetup> setup;  ///< Null: the curve cannot be made fair, `problem` says why.
  std::string problem;
  TargetLevels levels;
  Result<TargetOutcomes> outcomes = cancelled();
};

TargetsRun refused(Result<TargetOutcomes> why) {
  TargetsRun run;
  run.outcomes = std::move(why);
  return run;
}

TargetsRun prepared(const TargetsJob& job, const RunContext& context) {
  TargetsRun run;
  try {
    if (const auto error = validate(job.params)) return refused(fail(*error));
    if (job.curve.isEmpty()) return refused(fail(ErrorCode::BadParameter, "There is no curve to fair."));
    TargetOutcomes outcomes;
    if (job.spanAt) {
      outcomes.splits = targetSplits(job.curve, job.closed, job.params, context);
      outcomes.span = spanBetween(outcomes.splits, *job.spanAt, job.closed);
      run.levels = oneLevel({}, fitSpanTargets(job.curve, job.closed, job.params.targets, *outcomes.span));
    } else {
      run.levels = targetLevels(job.curve, job.closed, job.params, context);
      outcomes.splits = run.levels.ofTolerance().splits;
    }
    outcomes.targets = run.levels.targets;
    outcomes.recommendedDegree = outcomes.targets.recommendedDegree;
    auto setup = outcomes.span ? makeSpanSetup(job.curve, job.closed, job.params, *outcomes.span, context)
                               : makeSetup(job.curve, job.closed, job.params, context);
    if (!setup && setup.error().code != ErrorCode::Numerical) return refused(fail(setup.error()));
    if (setup) run.setup = std::move(*setup);
    if (!setup) run.problem = setup.error().message;
    run.outcomes = std::move(outcomes);
  } catch (const std::bad_alloc&) {
    run.outcomes = fail(ErrorCode::OutOfMemory, "Not enough memory to fair the curve.");
  }
  return run;
}

void runTarget(const TargetsJob& job, TargetsRun& run, int degree, const RunContext& context) {
  const int at = degree - 1;
  TargetOutcomes& outcomes = *run.outcomes;
  try {
    if (!run.setup) {
      outcomes.faired[at] = unchanged(job.curve, job.closed, Termination::Degenerate, run.problem, context);
      return;
    }
    const double tolerance = job.params.toleranceMm - run.setup->claimedMm();
    if (!(tolerance > 0.0)) {
      outcomes.faired[at] = withoutTolerance(job.curve, job.closed, job.params, context);
      return;
    }
    auto faired = fairOverLevels(run.setup, run.levels, degree, tolerance, context);
    if (faired) {
      faired->faired = againstSketch(*run.setup, std::move(faired->faired));
      outcomes.targets.profiles[at] = std::move(faired->profile);
      outcomes.faired[at] = std::move(faired->faired);
    } else {
      outcomes.problems[at] = faired.error().message;
    }
  } catch (const std::bad_alloc&) {
    outcomes.problems[at] = "Not enough memory to fair the curve.";
  }
}

/// What TargetSet recommends stays only where there is no curve.
void recommend(TargetsRun& run, const FairingParams& params) {
  TargetOutcomes& outcomes = *run.outcomes;
  const auto best = degreeToRecommend(outcomes.faired, outcomes.targets.recommendedDegree, params);
  if (best) outcomes.recommendedDegree = best;
}

}  // namespace

Result<FairedCurve> fairWithinTolerance(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                        const RunContext& context, const FairingLine& line) {
  return withSetup(curve, closed, params, context,
                   [&](const std::shared_ptr<const FairingSetup>& setup, const FairingParams& within) {
                     return within.tolerancePolicy == TolerancePolicy::All ? fairWithinTolerance(setup, within, context)
                                                                           : fairAsNeeded(setup, within, line, context);
                   });
}

std::vector<Result<TargetOutcomes>> fairAllTargets(std::span<const TargetsJob> jobs, const RunContext& context) {
  std::vector<TargetsRun> runs(jobs.size());
  parallelFor(context, static_cast<int>(jobs.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) runs[i] = prepared(jobs[i], context);
  });
  std::vector<std::size_t> order(jobs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto samples = [&](std::size_t i) { return runs[i].setup ? runs[i].setup->sampleCount() : 0; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return samples(a) > samples(b); });
  parallelFor(context, kMostTargetDegree * static_cast<int>(jobs.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const std::size_t job = order[i / kMostTargetDegree];
      if (runs[job].outcomes) runTarget(jobs[job], runs[job], i % kMostTargetDegree + 1, context);
    }
  });
  std::vector<Result<TargetOutcomes>> results;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    TargetsRun& run = runs[i];
    if (context.isCancelled()) run.outcomes = cancelled();
    if (run.outcomes) recommend(run, jobs[i].params);
    results.push_back(std::move(run.outcomes));
  }
  return results;
}

Result<TargetOutcomes> fairAllTargets(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                      const RunContext& context) {
  const TargetsJob job{curve, closed, params};
  return std::move(fairAllTargets(std::span(&job, 1), context).front());
}

Result<FairedCurve> fair(const NurbsCurve& curve, bool closed, const FairingParams& params, const RunContext& context,
                         const FairingLine& line) {
  if (const auto error = validate(params)) return fail(*error);
  if (curve.isEmpty()) return fail(ErrorCode::BadParameter, "There is no curve to fair.");
  switch (params.mode) {
    case FairingMode::None:
      return unchanged(curve, closed, Termination::NotRun, {}, context);
    case FairingMode::Tolerance:
      return fairWithinTolerance(curve, closed, params, context, line);
    case FairingMode::Monotone:
      return fairMonotone(curve, closed, params, context);
    case FairingMode::LowPass:
      return fairByLowPass(curve, closed, params, context);
    case FairingMode::Target:
      break;
  }
  if (params.target == FairingTarget::Drawn) {
    const TargetProfile drawn = drawnProfile(params.profile, closed);
    if (!drawn.valid) return unchanged(curve, closed, Termination::NotRun, drawn.problem, context);
    return modifyShape(curve, closed, drawn, params, context);
  }
  if (params.target == FairingTarget::LogAesthetic) {
    const auto target = logAestheticOf(curve, closed, params, context);
    if (!target.profile.valid) return unchanged(curve, closed, Termination::NotRun, target.profile.problem, context);
    auto faired = withSetup(curve, closed, params, context, [&](const auto& setup, const FairingParams& within) {
      return modifyShape(setup, target.profile, within.toleranceMm, context);
    });
    if (faired) faired->report.logAesthetic = target.spans;
    return faired;
  }
  return fairToTarget(curve, closed, params, context);
}

}  // namespace batten
