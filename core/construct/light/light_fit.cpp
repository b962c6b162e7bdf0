// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/construct/light/light_system.h"

namespace batten {
namespace {

constexpr int kFirstSteps = 12;       // of the first phase
constexpr double kSmallGain = 0.002;  // of the cost: two such steps in a row end a phase
constexpr double kHopeless = 2.5;     // tolerances off at the end of the first phase
constexpr double kStartDamping = 1e-3, kDampingDown = 0.3, kDampingUp = 6.0, kMostDamping = 1e8;
constexpr double kLongestLogStep = 0.5;  // of a span length's logarithm
constexpr double kMostLogLength = 2.2;
constexpr double kRowsReached = 0.02;  // of signs and ends
constexpr double kSignGrowth = 3.0, kMostSignWeight = 30.0;
constexpr LightWeights kFirst{1.0, 0.0, 0.0, 0.3};
constexpr LightWeights kSecond{0.15, 12.0, 1.0, 3.0};

class Levenberg {
 public:
  Levenberg(const LightReference& reference, LightShape start, const LightAsk& ask, const RunContext& context)
      : context_(context), ask_(ask), system_(reference, ask, start) {
    fit_.shape = std::move(start);
    const Eigen::Index n = system_.unknowns();
    matrix_.resize(n, n);
    damped_.resize(n, n);
    gradient_.resize(n);
    step_.resize(n);
  }

  LightFit run() {
    if (ask_.firstPhase) {
      weights_ = kFirst;
      const Ended ended = phase(kFirstSteps);
      if (ended != Ended::Slow || fit_.worst > kHopeless * ask_.tolerance) return fit_;
    }
    weights_ = kSecond;
    weights_.signs = ask_.signs;
    int left = ask_.mostSteps;
    while (phase(left) == Ended::Slow) {
      left -= stepsInPhase_;
      const bool signsWrong = cost_.wrongSign >= kRowsReached || cost_.ends >= kRowsReached;
      if (!signsWrong || weights_.signs >= kMostSignWeight || left <= 0) break;
      weights_.signs = std::min(kMostSignWeight, kSignGrowth * weights_.signs);
    }
    return fit_;
  }

 private:
  enum class Ended { Reached, Slow, Failed };

  bool isReached() const {
    return cost_.worst <= ask_.reach * ask_.tolerance && cost_.wrongSign < kRowsReached && cost_.ends < kRowsReached;
  }

  Ended phase(int steps) {
    cost_ = system_.evaluate(fit_.shape, weights_);
    if (!cost_.sound) return Ended::Failed;
    fit_.worst = cost_.worst;
    double damping = kStartDamping;
    int slow = 0;
    stepsInPhase_ = 0;
    while (!(fit_.reached = isReached())) {
      if (stepsInPhase_ >= steps || slow >= 2) return Ended::Slow;
      if (context_.isCancelled()) return Ended::Failed;
      ++stepsInPhase_;
      ++fit_.iterations;
      const double before = cost_.squares;
      if (!improve(damping)) return Ended::Slow;
      slow = before - cost_.squares < kSmallGain * before ? slow + 1 : 0;
    }
    return Ended::Reached;
  }

  /// One step that lowers the cost; false when none does.
  bool improve(double& damping) {
    system_.gauss(fit_.shape, weights_, matrix_, gradient_);
    while (damping < kMostDamping) {
      damped_ = matrix_;
      damped_.diagonal() += damping * matrix_.diagonal();
      const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(damped_);
      if (factor.info() == Eigen::Success) {
        step_ = -gradient_;
        factor.solveInPlace(step_);
        LightShape trial = moved();
        const LightSystem::Cost cost = system_.evaluate(trial, weights_);
        if (cost.sound && cost.squares < cost_.squares) {
          cost_ = cost;
          fit_.worst = cost.worst;
          fit_.shape = std::move(trial);
          damping = std::max(1e-9, damping * kDampingDown);
          return true;
        }
      }
      damping *= kDampingUp;
    }
    return false;
  }

  LightShape moved() const {
    LightShape trial = fit_.shape;
    for (std::size_t i = 0; i < trial.points.size(); ++i) {
      trial.points[i] += step_.segment<2>(2 * static_cast<Eigen::Index>(i));
    }
    if (trial.spans() == 1) return trial;
    double mean = 0.0;
    for (std::size_t i = 0; i < trial.logLengths.size(); ++i) {
      const double moved = step_[system_.firstLength() + static_cast<Eigen::Index>(i)];
      trial.logLengths[i] += std::clamp(moved, -kLongestLogStep, kLongestLogStep);
      mean += trial.logLengths[i] / trial.spans();
    }
    for (double& q : trial.logLengths) q = std::clamp(q - mean, -kMostLogLength, kMostLogLength);
    return trial;
  }

  const RunContext& context_;
  const LightAsk ask_;
  LightSystem system_;
  LightWeights weights_;
  LightSystem::Cost cost_;
  LightFit fit_;
  int stepsInPhase_ = 0;
  Eigen::MatrixXd matrix_, damped_;
  Eigen::VectorXd gradient_, step_;
};

}  // namespace

LightFit fitLight(const LightReference& reference, LightShape start, const LightAsk& ask, const RunContext& context) {
  return Levenberg(reference, std::move(start), ask, context).run();
}

}  // namespace batten
