// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/construct/light/light_matrix.h"
#include "core/construct/light/light_system.h"
#include "core/solve/levenberg_marquardt.h"

namespace batten {
namespace {

constexpr int kFirstSteps = 12;         // of the first phase
constexpr double kHopelessStart = 2.5;  // tolerances off at the end of the first phase
// The damping is raised by more than it is lowered, as every step that fails costs a solution and an evaluation.
constexpr double kDampingOnSuccess = 0.3, kDampingOnFailure = 6.0;  // times the damping before
// [-] Of the cost: 30 steps that lower it by less gain 6 % together, so that other weights do more for it.
constexpr double kSmallDecreaseOfLight = 0.002;
constexpr LevenbergOptions kLightSteps{.success = 1.0 / kDampingOnSuccess,
                                       .failure = kDampingOnFailure,
                                       .leastDamping = 1e-9,
                                       .mostDamping = 1e8,
                                       .smallDecrease = kSmallDecreaseOfLight};
constexpr double kLongestLogStep = 0.5;  // of a span length's logarithm
constexpr double kMostLogLength = 2.2;   // of a span length over their mean: a factor of 9 either way
constexpr double kRowsReached = 0.02;    // of signs and ends
// A fit of the second phase is given up that would not come to the cost of those that hold what they are asked for
// with the steps that are left, if each gained several times what the last ones did.
constexpr double kCostOfReached = 0.03;
constexpr int kStepsJudged = 4;     // the last ones, whose mean gain is taken
constexpr double kHopedGain = 5.0;  // times the logarithm of the gain of a step
// of the weight of the signs, from one phase of wrong signs to the next
constexpr double kSignGrowth = 3.0, kMostSignWeight = 30.0;
constexpr LightWeights kFirst{1.0, 0.0, 0.0, 0.3};     // the offsets alone, with a little of the held ends
constexpr LightWeights kSecond{0.15, 12.0, 1.0, 3.0};  // walls, signs and ends before the offsets

class LightProblem final : public LevenbergProblem {
 public:
  LightProblem(const LightReference& reference, LightShape start, const LightAsk& ask, const RunContext& context)
      : context_(context), ask_(ask), system_(reference, ask, start), matrix_(start, start.spans() > 1) {
    fit_.shape = std::move(start);
    gradient_.resize(matrix_.unknowns());
  }

  LightFit solve() {
    if (ask_.firstPhase) {
      weights_ = kFirst;
      const Phase first = phase(kFirstSteps);
      if (first.ended != Ended::Slow || fit_.worst > kHopelessStart * ask_.tolerance) return fit_;
    }
    weights_ = kSecond;
    weights_.signs = ask_.signs;
    int left = ask_.mostSteps;
    for (Phase now = phase(left); now.ended == Ended::Slow; now = phase(left)) {
      left -= now.steps;
      const bool signsWrong = cost_.wrongSign >= kRowsReached || cost_.ends >= kRowsReached;
      if (!signsWrong || weights_.signs >= kMostSignWeight || left <= 0) break;
      weights_.signs = std::min(kMostSignWeight, kSignGrowth * weights_.signs);
    }
    return fit_;
  }

  double linearise() override {
    system_.gauss(fit_.shape, weights_, matrix_, gradient_);
    return cost_.squares;
  }
  double tryStep(double damping) override {
    auto step = matrix_.solveDamped(damping, -gradient_);
    if (!step) return std::numeric_limits<double>::infinity();
    step_ = std::move(*step);
    moveTrial();
    trialCost_ = system_.evaluate(trial_, weights_);
    return trialCost_.sound ? trialCost_.squares : std::numeric_limits<double>::infinity();
  }
  void accept() override {
    cost_ = trialCost_;
    fit_.worst = cost_.worst;
    std::swap(fit_.shape, trial_);
    costs_.push_back(cost_.squares);
  }
  bool isReached() const override {
    return cost_.worst <= ask_.reach * ask_.tolerance && cost_.wrongSign < kRowsReached && cost_.ends < kRowsReached;
  }
  bool isHopeless() const override {
    const auto steps = std::ssize(costs_) - 1;
    if (weights_.wall == 0.0 || steps < kStepsJudged || costs_.back() <= kCostOfReached) return false;
    const double gain = std::log(*(costs_.end() - 1 - kStepsJudged) / costs_.back()) / kStepsJudged;
    return kHopedGain * gain * static_cast<double>(stepsLeft_ - steps) < std::log(costs_.back() / kCostOfReached);
  }

 private:
  enum class Ended { Reached, Slow, Failed };
  struct Phase {
    Ended ended;
    int steps;
  };

  Phase phase(int steps) {
    cost_ = system_.evaluate(fit_.shape, weights_);
    if (!cost_.sound) return {Ended::Failed, 0};
    fit_.worst = cost_.worst;
    fit_.reached = isReached();
    if (fit_.reached) return {Ended::Reached, 0};
    LevenbergOptions options = kLightSteps;
    options.iterations = stepsLeft_ = steps;
    costs_.assign(1, cost_.squares);
    const LevenbergRun run = levenbergMarquardt(*this, options, context_);
    fit_.iterations += run.iterations;
    fit_.reached = run.why == Termination::FixedPoint;
    const bool isOver = context_.isCancelled() || isHopeless();
    return {fit_.reached ? Ended::Reached : isOver ? Ended::Failed : Ended::Slow, run.iterations};
  }

  void moveTrial() {
    LightShape& trial = trial_;
    trial = fit_.shape;
    for (std::size_t i = 0; i < trial.points.size(); ++i) {
      trial.points[i] += step_.segment<2>(2 * static_cast<Eigen::Index>(i));
    }
    if (trial.spans() == 1) return;
    double mean = 0.0;
    for (std::size_t i = 0; i < trial.logLengths.size(); ++i) {
      const double moved = step_[system_.firstLength() + static_cast<Eigen::Index>(i)];
      trial.logLengths[i] += std::clamp(moved, -kLongestLogStep, kLongestLogStep);
      mean += trial.logLengths[i] / trial.spans();
    }
    for (double& q : trial.logLengths) q = std::clamp(q - mean, -kMostLogLength, kMostLogLength);
  }

  const RunContext& context_;
  const LightAsk ask_;
  LightSystem system_;
  LightWeights weights_;
  LightSystem::Cost cost_, trialCost_;
  LightFit fit_;
  LightShape trial_;
  std::vector<double> costs_;  ///< Of this phase, at its begin and after every step.
  int stepsLeft_ = 0;          ///< At its begin.
  LightMatrix matrix_;
  Eigen::VectorXd gradient_, step_;
};

}  // namespace

LightFit fitLight(const LightReference& reference, LightShape start, const LightAsk& ask, const RunContext& context) {
  return LightProblem(reference, std::move(start), ask, context).solve();
}

}  // namespace batten
