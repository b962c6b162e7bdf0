// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/minimise.h"

#include <algorithm>
#include <cmath>

#include "core/fairing/fairing_model.h"

namespace batten {
namespace {

constexpr double kSmallestDamping = 1e-9, kLargestDamping = 1e12;

/// The largest share of a step that keeps every sample's distance within the bound of the barrier, by the linear model.
double shareWithin(const FairingCorridor& corridor, const FairingState& state, const Eigen::VectorXd& change) {
  if (!(corridor.barrier > 0.0)) return 1.0;
  double share = 1.0;
  for (Eigen::Index i = 0; i < change.size(); ++i) {
    const double e = state.distance[i], c = change[i];
    const double room = c > 0.0 ? corridor.bound - e : corridor.bound + e;
    if (std::abs(c) > 0.0) share = std::min(share, 0.95 * room / std::abs(c));
  }
  return share;
}

}  // namespace

FairingRun minimise(const FairingSetup& setup, const FairingObjective& objective, const FairingCorridor& corridor,
                    FairingState start, double damping, const FairingLimits& limits, const RunContext& context) {
  FairingRun run;
  run.state = std::move(start);
  run.damping = damping;
  int small = 0;
  for (; run.iterations < limits.iterations && !context.isCancelled(); ++run.iterations) {
    const FairingModel model(setup, objective, corridor, run.state);
    std::optional<FairingState> better;
    while (!better && run.damping < kLargestDamping && !context.isCancelled()) {
      const auto step = model.step(run.damping);
      if (step) {
        const double share = shareWithin(corridor, run.state, model.distances(*step));
        std::vector<Vec2> points = run.state.points;
        setup.unknowns.move(share * *step, points);
        auto next = evaluate(setup, objective, corridor, std::move(points), run.state.feet);
        if (next && next->total < run.state.total) better = std::move(next);
      }
      if (!better) run.damping *= 8.0;
    }
    if (!better) {
      run.why = small > 0 || run.state.misfit <= 1e-24 ? Termination::Converged : Termination::NoProgress;
      return run;
    }
    const double decrease = run.state.total - better->total;
    small = decrease <= limits.relativeDecrease * run.state.total ? small + 1 : 0;
    const double before = run.state.total;
    run.state = std::move(*better);
    run.damping = std::max(kSmallestDamping, run.damping / 8.0);
    // A heavily damped step is short by itself and proves nothing.
    if (small >= 1 && (run.damping < 1e-2 || small >= 4)) {
      run.why = Termination::Converged;
      ++run.iterations;
      return run;
    }
    if (!(before > 1e-24)) break;
  }
  return run;
}

}  // namespace batten
