// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/shape_modification.h"

#include <algorithm>
#include <cmath>

#include "core/fairing/fairing_report.h"
#include "core/fairing/fairing_state.h"
#include "core/fairing/minimise.h"
#include "core/fairing/tolerance_fairing.h"

namespace batten {
namespace {

constexpr double kSmallestWeight = 1e-3, kLargestWeight = 1e5;
constexpr int kSearchSteps = 9;
/// The search for the weight ends when the deviation uses this share of the tolerance.
constexpr double kUsedShare = 0.95;
/// A search that leaves more of it unused got stuck in the noise of a rough start; the barrier then takes over.
constexpr double kStuckShare = 0.8;
/// A reference curvature below this (times extent) would weigh a straight line's rounding as shape.
constexpr double kSmallestReference = 1e-3;
constexpr FairingLimits kFull{40, 1e-4}, kWarm{8, 1e-3}, kPolish{12, 1e-5};
/// A long wavy curve whose target is plainly out of reach is not worth the last per cent of what the tolerance allows:
/// from so many samples on, a target farther off than so many tolerances after the first iterations is followed with
/// less effort.
constexpr int kLongCurve = 600;
constexpr double kOutOfReach = 10.0;
constexpr FairingLimits kProbe{12, 1e-3}, kRest{28, 1e-4}, kRough{4, 1e-2};
constexpr int kRoughSteps = 5;

/// One weight of the search: solution and its deviation.
struct Trial {
  double weight = 0.0, deviation = 0.0;
  FairingRun run;
};

class WeightSearch {
 public:
  WeightSearch(const FairingSetup& setup, const FairingObjective& objective, double toleranceMm,
               const RunContext& context)
      : setup_(setup), objective_(objective), toleranceMm_(toleranceMm), context_(context) {}

  /// Solves at a weight from the given control points. Absent when even the start cannot be evaluated.
  std::optional<Trial> solve(double weight, const std::vector<Vec2>& points, const std::vector<SpanPlace>& feet,
                             double damping, const FairingLimits& limits) {
    const FairingCorridor corridor{weight / toleranceMm_, 0.0, 0.0};
    auto state = evaluate(setup_, objective_, corridor, points, feet);
    if (!state) return std::nullopt;
    Trial trial;
    trial.weight = weight;
    trial.run = minimise(setup_, objective_, corridor, std::move(*state), damping, limits, context_);
    trial.deviation = largestDeviation(setup_, trial.run.state.points);
    iterations_ += trial.run.iterations;
    return trial;
  }
  std::optional<Trial> solveFromStart(double weight, const FairingLimits& limits) {
    return solve(weight, setup_.points, setup_.start.places, 1e-3, limits);
  }
  std::optional<Trial> solveFrom(const Trial& near, double weight, const FairingLimits& limits) {
    return solve(weight, near.run.state.points, near.run.state.feet, std::min(1e-3, near.run.damping), limits);
  }

  /// The smallest weight that keeps within the tolerance, between `wide` (which does not) and infinity.
  std::optional<Trial> search(Trial wide, bool rough) {
    const FairingLimits limits = rough ? kRough : kWarm;
    const double usedShare = rough ? kStuckShare : kUsedShare;
    const int steps = rough ? kRoughSteps : kSearchSteps;
    double guess = std::clamp(kSmallestWeight * wide.deviation / toleranceMm_ * 10.0, 1e-2, 1.0);
    std::optional<Trial> inside;
    while (!inside && guess <= kLargestWeight && !context_.isCancelled()) {
      const bool near = wide.deviation < 5.0 * toleranceMm_;
      auto trial = near ? solveFrom(wide, guess, limits) : solveFromStart(guess, limits);
      if (!trial) return std::nullopt;
      if (trial->deviation <= toleranceMm_) {
        inside = std::move(trial);
      } else {
        const double factor = std::clamp(2.0 * std::pow(trial->deviation / toleranceMm_, 1.5), 3.0, 100.0);
        guess *= factor;
        wide = std::move(*trial);
      }
    }
    for (int step = 0; inside && step < steps && !context_.isCancelled(); ++step) {
      if (inside->deviation >= usedShare * toleranceMm_ || inside->weight < 1.02 * wide.weight) break;
      const double a = std::log(wide.weight), b = std::log(inside->weight);
      const double da = std::log(wide.deviation / toleranceMm_);
      const double db = std::log(std::max(inside->deviation / toleranceMm_, 1e-9)) - std::log(0.5 * (1.0 + usedShare));
      const double share = std::clamp(da / std::max(da - db, 1e-12), 0.1, 0.9);
      auto trial = solveFrom(*inside, std::exp(a + share * (b - a)), limits);
      if (!trial) break;
      (trial->deviation <= toleranceMm_ ? *inside : wide) = std::move(*trial);
    }
    return inside;
  }
  int iterations() const { return iterations_; }

 private:
  const FairingSetup& setup_;
  const FairingObjective& objective_;
  double toleranceMm_;
  const RunContext& context_;
  int iterations_ = 0;
};

Result<FairingObjective> objectiveOf(const FairingSetup& setup, const TargetProfile& profile) {
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

}  // namespace

Result<FairedCurve> modifyShape(const FairingSetup& setup, const TargetProfile& profile, double toleranceMm,
                                const RunContext& context) {
  const auto objective = objectiveOf(setup, profile);
  if (!objective) return fail(objective.error());
  FairingReport report;
  WeightSearch search(setup, *objective, toleranceMm, context);
  const bool isLong = setup.sampleCount() > kLongCurve;
  auto full = search.solveFromStart(kSmallestWeight, isLong ? kProbe : kFull);
  const bool rough = isLong && full && full->deviation > kOutOfReach * toleranceMm;
  if (isLong && full && !rough && full->run.why == Termination::IterationLimit && !context.isCancelled()) {
    full = search.solveFrom(*full, kSmallestWeight, kRest);
  }
  if (context.isCancelled()) return cancelled();
  if (!full)
    return unchanged(setup.original, setup.closed, Termination::Degenerate, "The curve has a cusp and was left alone.");
  const auto before = evaluate(setup, *objective, {}, setup.points, setup.start.places);
  report.objectiveBefore = before ? std::sqrt(before->misfit) : 0.0;
  report.neededMm = full->deviation;
  report.withinTolerance = full->deviation <= toleranceMm;
  std::vector<Vec2> points = setup.points;
  if (report.withinTolerance) {
    points = full->run.state.points;
    report.why = full->run.why;
  } else {
    report.why = Termination::ToleranceLimited;
    report.note = "The profile was followed as far as the tolerance allows.";
    if (auto inside = search.search(std::move(*full), rough)) {
      points = inside->run.state.points;
      if (auto polished = rough ? std::nullopt : search.solveFrom(*inside, inside->weight, kPolish))
        points = polished->run.state.points;
    }
  }
  if (context.isCancelled()) return cancelled();
  report.iterations = search.iterations();
  const double deviation = keepWithin(setup, toleranceMm, points);
  if (!report.withinTolerance && !rough && deviation < kStuckShare * toleranceMm) {
    BoundedRun bounded = minimiseWithin(setup, *objective, toleranceMm, points, context);
    if (context.isCancelled()) return cancelled();
    report.iterations += bounded.iterations;
    keepWithin(setup, toleranceMm, bounded.points);
    const auto old = evaluate(setup, *objective, {}, points, setup.start.places);
    const auto now = evaluate(setup, *objective, {}, bounded.points, setup.start.places);
    if (now && (!old || now->misfit < old->misfit)) points = std::move(bounded.points);
  }
  const auto after = evaluate(setup, *objective, {}, points, setup.start.places);
  report.objectiveAfter = after ? std::sqrt(after->misfit) : report.objectiveBefore;
  if (!report.withinTolerance && largestDeviation(setup, points) < kStuckShare * toleranceMm) {
    // The corridor had room left: it was not what stopped the curve.
    report.why = Termination::NoProgress;
    report.note = rough ? "The profile lies far out of reach for this curve. Split it, or mark its corners."
                        : "The curve is too rough to follow the profile further. Fair it by tolerance first.";
  }
  return finished(setup, std::move(points), toleranceMm, std::move(report));
}

Result<FairedCurve> modifyShape(const NurbsCurve& curve, bool closed, const TargetProfile& profile,
                                const FairingParams& params, const RunContext& context) {
  return withSetup(curve, closed, params,
                   [&](const FairingSetup& setup) { return modifyShape(setup, profile, params.toleranceMm, context); });
}

}  // namespace batten
