// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>

namespace batten {

namespace {

/// Raises the damping until a step decreases the cost. @return whether one did; it is accepted.
bool improve(LevenbergProblem& problem, const LevenbergOptions& options, LevenbergRun& run, const RunContext& context) {
  for (int attempt = 0; attempt < options.attempts && run.damping < options.mostDamping; ++attempt) {
    if (context.isCancelled()) return false;
    const double cost = problem.tryStep(run.damping);
    if (cost < run.cost) {
      problem.accept();
      run.cost = cost;
      run.damping = std::max(options.leastDamping, run.damping / options.success);
      return true;
    }
    run.damping *= options.failure;
    if (problem.promised() < options.leastPromise * run.cost) return false;
  }
  return false;
}

}  // namespace

LevenbergRun levenbergMarquardt(LevenbergProblem& problem, const LevenbergOptions& options, const RunContext& context) {
  LevenbergRun run;
  run.damping = options.damping;
  int small = 0;  // steps in a row
  while (run.iterations < options.iterations && !context.isCancelled()) {
    run.cost = problem.linearise();
    ++run.iterations;
    const double before = run.cost;
    if (!std::isfinite(before)) {
      run.why = Termination::Degenerate;
      return run;
    }
    if (!improve(problem, options, run, context)) {
      if (context.isCancelled()) break;
      const bool settled = small > 0 || run.cost <= options.negligible;
      run.why = settled ? Termination::Converged : Termination::NoProgress;
      return run;
    }
    small = before - run.cost < options.smallDecrease * before ? small + 1 : 0;
    const int enough = run.damping < options.freeDamping ? options.smallSteps : options.smallStepsDamped;
    if (problem.isReached()) {
      run.why = Termination::FixedPoint;
      return run;
    }
    if (problem.isHopeless()) {
      run.why = Termination::NoProgress;
      return run;
    }
    if (small >= enough || run.cost <= options.negligible) {
      run.why = Termination::Converged;
      return run;
    }
  }
  return run;
}

}  // namespace batten
