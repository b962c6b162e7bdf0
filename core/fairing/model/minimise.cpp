// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/minimise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/fairing/model/fairing_model.h"
#include "core/solve/levenberg_marquardt.h"

namespace batten {
namespace {

constexpr double kNoMisfit = 1e-24;  // a millionth of a millionth of the reference, squared
/// Part of a small decrease that a step must promise, for a shorter one to be tried after it.
constexpr double kLeastPromise = 1e-4;
// what differs from the usual steps
constexpr LevenbergOptions kFairingSteps{.success = 8.0,
                                         .failure = 8.0,
                                         .leastDamping = 1e-9,
                                         .mostDamping = 1e12,
                                         .smallSteps = 1,
                                         .smallStepsDamped = 4,
                                         .negligible = kNoMisfit};

/// Of the way to the bound that one step may go, so that the barrier stays finite (interior point).
constexpr double kBarrierShare = 0.95;

/// The largest share of a step that keeps every sample's distance within the bound of the barrier, by the linear model.
double shareWithin(const FairingCorridor& corridor, const FairingState& state, const FairingModel& model,
                   const Eigen::VectorXd& step) {
  if (!corridor.barrier) return 1.0;
  const Eigen::VectorXd change = model.distances(step);
  const double bound = corridor.barrier->boundMm;
  double share = 1.0;
  for (Eigen::Index i = 0; i < change.size(); ++i) {
    const double e = state.samples[i].distance, c = change[i];
    const double room = c > 0.0 ? bound - e : bound + e;
    if (std::abs(c) > 0.0) share = std::min(share, kBarrierShare * room / std::abs(c));
  }
  return share;
}

class FairingProblem final : public LevenbergProblem {
 public:
  FairingProblem(const FairingSetup& setup, const FairingObjective& objective, const FairingCorridor& corridor,
                 FairingState start, double slideFloor)
      : setup_(setup), objective_(objective), corridor_(corridor), slideFloor_(slideFloor), state_(std::move(start)) {}

  double linearise() override {
    if (model_) {
      model_->remake(objective_, corridor_, state_);
    } else {
      model_.emplace(setup_, objective_, corridor_, state_, slideFloor_);
    }
    return state_.total;
  }
  double tryStep(double damping) override {
    const auto step = model_->step(damping);
    if (!step) return std::numeric_limits<double>::infinity();
    const double share = shareWithin(corridor_, state_, *model_, *step);
    std::vector<Vec2> points = state_.points;
    setup_.unknowns.move(share * *step, points);
    promised_ = -2.0 * share * model_->gradient().dot(*step);
    trial_ = evaluate(setup_, objective_, corridor_, std::move(points), state_.feet(), state_.total);
    return trial_ ? trial_->total : std::numeric_limits<double>::infinity();
  }
  double promised() const override { return promised_; }
  void accept() override { state_ = std::move(*trial_); }
  FairingState& state() { return state_; }

 private:
  const FairingSetup& setup_;
  const FairingObjective& objective_;
  const FairingCorridor& corridor_;
  double slideFloor_;
  FairingState state_;
  double promised_ = std::numeric_limits<double>::infinity();
  std::optional<FairingState> trial_;
  std::optional<FairingModel> model_;
};

}  // namespace

FairingRun minimise(const FairingSetup& setup, const FairingObjective& objective, const FairingCorridor& corridor,
                    FairingState start, const FairingLimits& limits, const RunContext& context) {
  FairingProblem problem(setup, objective, corridor, std::move(start), limits.slideFloor);
  LevenbergOptions options = kFairingSteps;
  options.iterations = limits.iterations;
  options.smallDecrease = limits.relativeDecrease;
  options.leastPromise = kLeastPromise * limits.relativeDecrease;
  options.damping = limits.damping;
  const LevenbergRun run = levenbergMarquardt(problem, options, context);
  const bool settled = run.why == Termination::NoProgress && problem.state().misfit <= kNoMisfit;
  return {std::move(problem.state()), settled ? Termination::Converged : run.why, run.iterations, run.damping};
}

}  // namespace batten
