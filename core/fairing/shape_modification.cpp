// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/shape_modification.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/curve/curvature.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/fairing_state.h"
#include "core/fairing/target_steps.h"
#include "core/fairing/tolerance_fairing.h"

namespace batten {
namespace {

/// Steps between two of TargetSteps, to use as much of the tolerance as this.
constexpr int kSearchSteps = 5;
constexpr double kUsedShare = 0.95;
/// A search that leaves more of it unused got stuck in the noise of a rough start; the barrier then takes over.
constexpr double kStuckShare = 0.8;
/// Room for what lies between the places where the deviation is measured.
constexpr double kMeasured = 0.999;

constexpr const char* kNothingWon =
    "Left as sketched: within the tolerance, this target would add curvature extrema. Raise the tolerance, split the "
    "profile, or smooth without a target.";

/// Of all curves within the tolerance the one with the fewest extrema, of these the one nearest to the target.
class ShapeModification {
 public:
  ShapeModification(const FairingSetup& setup, const FairingObjective& objective, double toleranceMm,
                    const RunContext& context)
      : setup_(setup),
        objective_(objective),
        toleranceMm_(toleranceMm),
        context_(context),
        steps_(setup, objective, context),
        asked_(extremaAsked(setup, objective)) {}

  Result<FairedCurve> run() {
    if (context_.isCancelled()) return cancelled();
    if (steps_.all().empty()) {
      return unchanged(setup_.original, setup_.closed, Termination::Degenerate,
                       "The curve has a cusp and was left alone.");
    }
    const auto before = evaluate(setup_, objective_, {}, setup_.points, setup_.start.places);
    const TargetStep& full = steps_.all().front();
    best_.points = setup_.points;
    best_.misfit = before ? before->misfit : full.misfit;
    best_.extrema = countedExtrema(setup_.original, setup_.closed);
    best_.why = Termination::FixedPoint;
    report_.objectiveBefore = std::sqrt(best_.misfit);
    report_.neededMm = full.deviationMm;
    report_.withinTolerance = isWithin(full);
    for (const TargetStep& step : steps_.all()) {
      if (isWithin(step)) take(step);
    }
    if (best_.why == Termination::FixedPoint || best_.weight > full.weight) useTolerance();
    if (context_.isCancelled()) return cancelled();
    return done();
  }

 private:
  bool isWithin(const TargetStep& step) const { return step.deviationMm <= kMeasured * toleranceMm_; }
  /// Extrema that the target itself has are no fault.
  int rank(const TargetStep& step) const { return std::max(step.extrema, asked_); }

  void take(const TargetStep& step) {
    if (rank(step) < rank(best_) || (rank(step) == rank(best_) && step.misfit < best_.misfit)) best_ = step;
  }
  void takeOfSameRank(const TargetStep& step) {
    if (isWithin(step) && rank(step) == rank(best_)) take(step);
  }

  /// Between the last step that leaves the tolerance and the first that keeps it.
  void useTolerance() {
    const TargetStep *outside = nullptr, *inside = nullptr;
    for (const TargetStep& step : steps_.all()) {
      if (isWithin(step)) {
        inside = &step;
        break;
      }
      outside = &step;
    }
    if (!outside) return;
    TargetStep wide = *outside;
    std::optional<TargetStep> near;
    if (inside) near = *inside;
    for (int i = 0; i < (steps_.isRough() ? 2 : kSearchSteps) && !context_.isCancelled(); ++i) {
      if (near && (near->deviationMm >= kUsedShare * toleranceMm_ || near->weight < 1.02 * wide.weight)) break;
      auto step = steps_.between(near ? *near : wide, near ? weightBetween(wide, *near) : 4.0 * wide.weight);
      if (!step) break;
      takeOfSameRank(*step);
      if (isWithin(*step)) {
        near = std::move(step);
      } else {
        wide = std::move(*step);
      }
    }
    if (best_.why == Termination::FixedPoint || context_.isCancelled()) return;
    if (const auto polished = steps_.polished(best_)) takeOfSameRank(*polished);
    if (!steps_.isRough() && best_.deviationMm < kStuckShare * toleranceMm_) useBarrier();
  }

  double weightBetween(const TargetStep& wide, const TargetStep& near) const {
    const double a = std::log(wide.weight), b = std::log(near.weight);
    const double da = std::log(wide.deviationMm / toleranceMm_);
    const double db = std::log(std::max(near.deviationMm / toleranceMm_, 1e-9)) - std::log(0.5 * (1.0 + kUsedShare));
    return std::exp(a + std::clamp(da / std::max(da - db, 1e-12), 0.1, 0.9) * (b - a));
  }

  void useBarrier() {
    BoundedRun bounded = minimiseWithin(setup_, objective_, toleranceMm_, best_.points, context_);
    if (context_.isCancelled()) return;
    report_.iterations += bounded.iterations;
    TargetStep step = best_;
    step.points = std::move(bounded.points);
    step.deviationMm = keepWithin(setup_, toleranceMm_, step.points);
    const auto state = evaluate(setup_, objective_, {}, step.points, setup_.start.places);
    const auto curve = toCurve(setup_, step.points);
    if (!state || !curve) return;
    step.misfit = state->misfit;
    step.extrema = countedExtrema(*curve, setup_.closed);
    takeOfSameRank(step);
  }

  Result<FairedCurve> done() {
    report_.iterations += steps_.iterations();
    report_.objectiveAfter = std::sqrt(best_.misfit);
    report_.why = report_.withinTolerance ? best_.why : Termination::ToleranceLimited;
    const bool adds = std::none_of(steps_.all().begin(), steps_.all().end(), [this](const TargetStep& step) {
      return isWithin(step) && rank(step) <= rank(best_);
    });
    if (best_.why == Termination::FixedPoint && adds) {
      report_.why = Termination::ToleranceLimited;
      report_.withinTolerance = false;
      report_.note = kNothingWon;
    } else if (!report_.withinTolerance) {
      report_.note = "The profile was followed as far as the tolerance allows.";
      if (best_.deviationMm < kStuckShare * toleranceMm_) {
        // The corridor had room left: it was not what stopped the curve.
        report_.why = Termination::NoProgress;
        report_.note = steps_.isRough()
                           ? "The profile lies far out of reach for this curve. Split it, or mark its corners."
                           : "The curve follows the profile only so far without more curvature extrema. Fair it by "
                             "tolerance first, or raise the tolerance.";
      }
    } else if (best_.weight > steps_.all().front().weight && best_.extrema < steps_.all().front().extrema) {
      report_.note = "The profile was followed as far as no curvature extremum is added.";
    }
    return finished(setup_, std::move(best_.points), toleranceMm_, std::move(report_));
  }

  const FairingSetup& setup_;
  const FairingObjective& objective_;
  double toleranceMm_;
  const RunContext& context_;
  TargetSteps steps_;
  int asked_;
  TargetStep best_;
  FairingReport report_;
};

}  // namespace

Result<FairedCurve> modifyShape(const FairingSetup& setup, const TargetProfile& profile, double toleranceMm,
                                const RunContext& context) {
  const auto objective = targetObjective(setup, profile);
  if (!objective) return fail(objective.error());
  return ShapeModification(setup, *objective, toleranceMm, context).run();
}

Result<FairedCurve> modifyShape(const NurbsCurve& curve, bool closed, const TargetProfile& profile,
                                const FairingParams& params, const RunContext& context) {
  return withSetup(curve, closed, params, [&](const std::shared_ptr<const FairingSetup>& setup) {
    return modifyShape(*setup, profile, params.toleranceMm, context);
  });
}

}  // namespace batten
