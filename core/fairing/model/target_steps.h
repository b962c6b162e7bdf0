// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/base/termination.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/model/fairing_state.h"
#include "core/fairing/model/minimise.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// The objective that a target profile stands for. @return why there is none.
Result<FairingObjective> targetObjective(const FairingSetup& setup, const TargetProfile& profile);

/// Times that the profile turns back by more than an extremum rises: what a curve that follows it must have.
int extremaAsked(const FairingSetup& setup, const FairingObjective& objective);

/// A curve on the way from a target to the sketch.
struct TargetStep {
  double weight = 0.0;       ///< [1/mm] Of the distance from the sketch.
  std::vector<Vec2> points;  ///< Control points. [mm]
  std::vector<SpanPlace> feet;
  double damping = 1e-3;  ///< As FairingLimits::damping.
  double misfit = 0.0;    ///< Of the profile, squared.
  Termination why = Termination::IterationLimit;
  const FairingSetup* setup = nullptr;  ///< Of the points.

  /// From the sketch, both ways. This and the extrema are measured where they are asked for: many steps are only known
  /// to be too far off.
  double deviationMm() const;
  bool isWithin(double mm) const;  ///< deviationMm() <= mm
  int extrema() const;             ///< Of the usual prominence.
  void measured(double deviationMm, int extrema);

 private:
  mutable std::optional<double> deviationMm_;
  /// What is known of the deviation, where all of it is not.
  mutable double leastMm_ = 0.0, mostMm_ = std::numeric_limits<double>::infinity();
  mutable std::optional<int> extrema_;
};

/// Follows a target: the curve that meets it fully, and curves that hold nearer and nearer to the sketch. They depend
/// on sketch and target alone, so what is found within a tolerance is found within a larger one too.
class TargetSteps {
 public:
  /// @param context must outlive it, as must the setup and the objective.
  /// @param mostMm the steps end, and none meets the target, where the curve has left the sketch by more than this.
  TargetSteps(const FairingSetup& setup, const FairingObjective& objective, const RunContext& context,
              double mostMm = std::numeric_limits<double>::infinity());

  /// As if they had been followed with this bound; what is known already is not made again.
  void reach(double mostMm);
  /// The first meets the target fully, but where they ended before (endsEarly). Empty when the sketch has a cusp, or
  /// when cancelled.
  std::span<const TargetStep> steps() const { return std::span(steps_).subspan(passedOver_); }
  bool endsEarly() const { return early_; }
  /// Less effort was made: a long curve, and a target far out of its reach.
  bool isRough() const { return rough_ && !early_; }
  /// A step of another weight, from one of these steps that is near. Kept: the searches of several tolerances ask for
  /// the same ones. @return null where there is none.
  const TargetStep* between(const TargetStep& from, double weight) const;
  std::optional<TargetStep> polished(const TargetStep& from) const;
  int iterations() const { return iterations_; }

 private:
  void follow(double mostMm);
  std::optional<std::size_t> firstBeyond(double mostMm) const;
  double weightOf(int step) const;
  std::optional<TargetStep> solve(double weight, const TargetStep& from, const FairingLimits& limits) const;

  /// What between() has made.
  struct Made {
    double fromWeight, fromMisfit, weight;
    std::optional<TargetStep> step;
  };

  const FairingSetup& setup_;
  const FairingObjective& objective_;
  const RunContext& context_;
  std::vector<TargetStep> steps_;          ///< From the target, or where they ended, to the sketch.
  std::size_t passedOver_ = 0;             ///< Of them: beyond the bound.
  double smallest_ = 0.0, largest_ = 0.0;  ///< Weights of the steps at the target and at the sketch.
  int count_ = 0;                          ///< Steps beside the first.
  std::optional<int> next_;                ///< The one to be made next; nothing: the last one was made, or failed.
  bool long_ = false, rough_ = false, early_ = false;
  mutable std::deque<Made> made_;  ///< Whose steps stay where they are.
  mutable int iterations_ = 0;
};

}  // namespace batten
