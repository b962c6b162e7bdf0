// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/target_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/curve/curvature.h"
#include "core/curve/extremum_indices.h"
#include "core/fairing/model/sketch_deviation.h"
#include "core/solve/levenberg_marquardt.h"

namespace batten {
namespace {

/// Weight of the distance, in 1/extent: at last hardly any.
constexpr double kSmallestWeight = 0.5, kWeightStep = 8.0, kRoughWeightStep = 16.0;
/// [extents] At first the curve leaves the sketch by about this.
constexpr double kHardlyMoved = 1e-4;
constexpr int kMostSteps = 10;  // limits the work
/// A reference curvature below this (times extent) would weigh a straight line's rounding as shape.
constexpr double kSmallestReference = 1e-3;
/// The curve at the target and the one that is taken come to rest within these steps, not by many small ones: a floor
/// against sliding that low is no hindrance near the goal.
constexpr double kFreeSlide = 1e-3;
// [iterations, share of the objective] at the target, from a near step, and at the end
constexpr FairingLimits kFull{.iterations = 12, .relativeDecrease = 1e-3, .slideFloor = kFreeSlide}, kWarm{6, 1e-3},
    kPolish{.iterations = 12, .relativeDecrease = 1e-5, .slideFloor = kFreeSlide};
/// A long wavy curve whose target is plainly out of reach is not worth the last per cent: from so many samples on, a
/// target farther off than this share of the extent after the first iterations is followed with less effort.
constexpr int kLongCurve = 600;
constexpr double kOutOfReach = 0.02;  // of the extent
constexpr FairingLimits kProbe{.iterations = 12, .relativeDecrease = 1e-3, .slideFloor = kFreeSlide},
    kRest{.iterations = 12, .relativeDecrease = 1e-3, .slideFloor = kFreeSlide},
    kRough{4, 1e-2};  // the same, of long curves

/// Of the control points. No place of the curve moves farther, and hardly a foot point is missed by as much again.
constexpr double kSurelyWithin = 2.0;
double largestMove(const FairingSetup& setup, const std::vector<Vec2>& points) {
  if (setup.sketch) return std::numeric_limits<double>::infinity();  // begins beside the sketch
  double most = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) most = std::max(most, (points[i] - setup.points[i]).norm());
  return most;
}

}  // namespace

Result<FairingObjective> targetObjective(const FairingSetup& setup, const TargetProfile& profile) {
  if (!profile.valid) return fail(ErrorCode::BadParameter, profile.problem.empty() ? "No target." : profile.problem);
  FairingObjective objective;
  double sum = 0.0;
  bool positive = false, negative = false;
  for (int i = 0; i < setup.sampleCount(); ++i) {
    const double value = profile.value(setup.fraction(i)), kappa = profile.curvatureAt(setup.fraction(i));
    positive = positive || value > 0.0;
    negative = negative || !(value > 0.0);
    if (!std::isfinite(kappa)) return fail(ErrorCode::Numerical, "The target is not finite.");
    objective.wanted.push_back(kappa);
    sum += kappa * kappa;
  }
  if (profile.quantity == TargetQuantity::Radius && positive && negative) {
    return fail(ErrorCode::Numerical, "The radius profile passes through zero: no curve can follow it.");
  }
  objective.reference = std::max(std::sqrt(sum / setup.sampleCount()), kSmallestReference / setup.extent);
  return objective;
}

int extremaAsked(const FairingSetup& setup, const FairingObjective& objective) {
  return countExtrema(objective.wanted, kExtremumProminence / setup.extent, setup.closed);
}

double TargetStep::deviationMm() const {
  if (!deviationMm_) deviationMm_ = largestDeviation(*setup, points, true);
  return *deviationMm_;
}

bool TargetStep::isWithin(double mm) const {
  if (deviationMm_) return *deviationMm_ <= mm;
  if (mm == std::numeric_limits<double>::infinity()) return true;
  if (leastMm_ > mm) return false;
  if (mostMm_ <= mm) return true;
  if (kSurelyWithin * largestMove(*setup, points) <= mm || isClearlyWithin(*setup, points, mm)) {
    mostMm_ = mm;
    return true;
  }
  const double deviation = largestDeviation(*setup, points, true, mm);
  if (deviation > mm) {
    leastMm_ = deviation;
  } else {
    deviationMm_ = deviation;
  }
  return deviation <= mm;
}

int TargetStep::extrema() const {
  if (!extrema_) {
    const auto curve = toCurve(*setup, points);
    extrema_ = curve ? countedExtrema(*curve, setup->closed, setup->check) : 0;
  }
  return *extrema_;
}

void TargetStep::measured(double deviationMm, int extrema) {
  deviationMm_ = deviationMm;
  extrema_ = extrema;
}

TargetSteps::TargetSteps(const FairingSetup& setup, const FairingObjective& objective, const RunContext& context,
                         double mostMm)
    : setup_(setup), objective_(objective), context_(context), long_(setup.sampleCount() > kLongCurve) {
  const auto start = evaluate(setup, objective, {}, setup.points, setup.start.places);
  if (!start) return;
  smallest_ = kSmallestWeight / setup.extent;
  largest_ = std::max(smallest_, std::sqrt(start->misfit) / (kHardlyMoved * setup.extent));
  const double wanted = std::log(largest_ / smallest_) / std::log(long_ ? kRoughWeightStep : kWeightStep);
  count_ = std::clamp(static_cast<int>(std::ceil(wanted)), 1, kMostSteps);
  next_ = count_;
  reach(mostMm);
}

void TargetSteps::reach(double mostMm) {
  auto beyond = firstBeyond(mostMm);
  if (!beyond && next_) {
    follow(mostMm);
    beyond = firstBeyond(mostMm);
  }
  early_ = beyond.has_value();
  passedOver_ = beyond.value_or(0);
}

/// On the way from the sketch; the step at the target is no reason to end before it.
std::optional<std::size_t> TargetSteps::firstBeyond(double mostMm) const {
  for (std::size_t i = steps_.size(); i-- > 0;)
    if (steps_[i].weight > smallest_ && !steps_[i].isWithin(mostMm)) return i;
  return std::nullopt;
}

double TargetSteps::weightOf(int step) const {
  return smallest_ * std::pow(largest_ / smallest_, static_cast<double>(step) / count_);
}

/// From the sketch to the target: each step starts from the one before, which lies near.
void TargetSteps::follow(double mostMm) {
  TargetStep from;
  from.points = setup_.points;
  from.feet = setup_.start.places;
  from.damping = LevenbergOptions{}.damping;
  if (!steps_.empty()) from = steps_.front();
  std::reverse(steps_.begin(), steps_.end());
  bool isBeyond = false;
  while (next_ && !isBeyond && !context_.isCancelled()) {
    const int i = *next_;
    next_ = i > 0 ? std::optional(i - 1) : std::nullopt;
    const FairingLimits limits = i > 0 ? (long_ ? kRough : kWarm) : long_ ? kProbe : kFull;
    auto step = solve(weightOf(i), from, limits);
    if (!step) break;
    isBeyond = i > 0 && !step->isWithin(mostMm);
    from = *step;
    steps_.push_back(std::move(*step));
  }
  std::reverse(steps_.begin(), steps_.end());
  if (context_.isCancelled()) steps_.clear();
  if (isBeyond) return;
  next_.reset();
  rough_ = long_ && !steps_.empty() && !steps_.front().isWithin(kOutOfReach * setup_.extent);
  if (!long_ || rough_ || steps_.empty() || steps_.front().why != Termination::IterationLimit) return;
  if (auto step = solve(smallest_, steps_.front(), kRest)) steps_.front() = std::move(*step);
}

std::optional<TargetStep> TargetSteps::solve(double weight, const TargetStep& from, const FairingLimits& limits) const {
  const FairingCorridor corridor{.weight = weight};
  auto state = evaluate(setup_, objective_, corridor, from.points, from.feet);
  if (!state) return std::nullopt;
  FairingLimits damped = limits;
  damped.damping = std::min(limits.damping, from.damping);
  FairingRun run = minimise(setup_, objective_, corridor, std::move(*state), damped, context_);
  iterations_ += run.iterations;
  const auto curve = toCurve(setup_, run.state.points);
  if (!curve || context_.isCancelled()) return std::nullopt;
  TargetStep step;
  step.weight = weight;
  step.damping = run.damping;
  step.misfit = run.state.misfit;
  step.why = run.why;
  step.setup = &setup_;
  step.points = std::move(run.state.points);
  step.feet = run.state.feet();
  return step;
}

const TargetStep* TargetSteps::between(const TargetStep& from, double weight) const {
  const auto isIt = [&](const Made& made) {
    return made.weight == weight && made.fromWeight == from.weight && made.fromMisfit == from.misfit;
  };
  auto found = std::find_if(made_.begin(), made_.end(), isIt);
  if (found == made_.end()) {
    made_.push_back({from.weight, from.misfit, weight, solve(weight, from, isRough() ? kRough : kWarm)});
    found = made_.end() - 1;
  }
  return found->step ? &*found->step : nullptr;
}

std::optional<TargetStep> TargetSteps::polished(const TargetStep& from) const {
  return isRough() ? std::nullopt : solve(from.weight, from, kPolish);
}

}  // namespace batten
