// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/structure/monotone_fairing.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/number_text.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/model/target_steps.h"
#include "core/fairing/structure/structure_candidates.h"

namespace batten {
namespace {

/// Curves of more samples are not tried by targets: they are long and wavy, and each takes seconds.
constexpr int kMostTargetSamples = 600;
/// A target is followed until the curve has left the sketch by so many times what is wanted.
constexpr double kTargetReach = 2.0;

/// Three digits, rounded up: a tolerance that is said to be enough has to be.
std::string millimetres(double mm) {
  const double digit = mm > 0.0 ? std::pow(10.0, std::floor(std::log10(mm)) - 2.0) : 1.0;
  return significantText(std::ceil(mm / digit - 1e-9) * digit, 3) + " mm";
}

std::string extremaText(int count) {
  if (count == 0) return "monotone curvature";
  return counted(count, "curvature extremum", "curvature extrema");
}

class MonotoneFairing {
 public:
  MonotoneFairing(const std::shared_ptr<const FairingSetup>& setup, const FairingParams& params,
                  const RunContext& context)
      : setup_(*setup), params_(params), context_(context), candidates_(setup, context) {}

  Result<FairedCurve> run() {
    if (context_.isCancelled()) return cancelled();
    if (!candidates_.isValid()) {
      return unchanged(setup_.original, setup_.closed, Termination::Degenerate,
                       "The curve has a cusp and was not changed.");
    }
    if (!params_.keptAt.empty()) return byPlace();
    return params_.keepExtrema.count ? byCount(*params_.keepExtrema.count) : asFewAsCan();
  }

 private:
  double most() const { return kToleranceRoom * params_.toleranceMm; }

  Result<FairedCurve> byPlace() {
    auto wanted = candidates_.nearestWith(params_.keptAt);
    if (context_.isCancelled()) return cancelled();
    if (wanted && wanted->deviationMm <= most()) return done(*wanted);
    const StructureCandidate best = candidates_.fewest(most());
    if (context_.isCancelled()) return cancelled();
    std::optional<double> needed;
    if (wanted) needed.emplace(wanted->deviationMm);
    return limited(best, needed);
  }

  /// What a number of extrema needs is the least of what all ways need, whatever the tolerance. Of the curves within
  /// the tolerance the one that turns back no more often than asked is taken, of these the nearest.
  Result<FairedCurve> byCount(int asked) {
    std::vector<StructureCandidate> reached;
    if (auto nearest = candidates_.nearest(asked)) reached.push_back(std::move(*nearest));
    const bool isSketch = !reached.empty() && !(reached.front().deviationMm > 0.0);
    const double reach = reached.empty() ? std::numeric_limits<double>::infinity() : reached.front().deviationMm;
    const std::vector<StructureCandidate> steps =
        isSketch ? std::vector<StructureCandidate>{} : targetCurves(kTargetReach * reach);
    std::copy_if(steps.begin(), steps.end(), std::back_inserter(reached),
                 [&](const StructureCandidate& step) { return step.extrema <= asked; });
    if (context_.isCancelled()) return cancelled();
    std::optional<double> needed;
    const StructureCandidate* best = nullptr;
    for (const StructureCandidate& one : reached) {
      needed = std::min(needed.value_or(one.deviationMm), one.deviationMm);
      if (one.deviationMm <= most() && (!best || isTruerThan(one, *best, asked))) best = &one;
    }
    if (best) return done(*best, *needed);
    StructureCandidate other = candidates_.fewest(most(), asked);
    offer(steps, other);
    if (context_.isCancelled()) return cancelled();
    return limited(other, needed);
  }

  Result<FairedCurve> asFewAsCan() {
    StructureCandidate best = candidates_.fewest(most());
    if (context_.isCancelled()) return cancelled();
    const int least = setup_.closed ? 4 : 0;
    if (countedExtrema(setup_.original, setup_.closed, context_) > least) {
      // Where none has fewer extrema, only a nearer one is better.
      const bool isLeast = best.extrema <= least && best.allExtrema <= least;
      offer(targetCurves(kTargetReach * (isLeast ? best.deviationMm : params_.toleranceMm)), best);
    }
    if (context_.isCancelled()) return cancelled();
    return done(best);
  }

  /// What a target reaches is to be had here too: the curves on the way to all targets, up to about a distance.
  std::vector<StructureCandidate> targetCurves(double mostMm) {
    std::vector<StructureCandidate> curves;
    if (setup_.sampleCount() > kMostTargetSamples) return curves;
    const TargetSet targets = fitTargets(setup_.original, params_.targets, setup_.closed);
    for (const TargetProfile& profile : targets.profiles) {
      const auto objective = targetObjective(setup_, profile);
      if (!objective) continue;
      const TargetSteps followed(setup_, *objective, context_, mostMm);
      iterations_ += followed.iterations();
      for (const TargetStep& step : followed.steps())
        curves.push_back(candidates_.overSketch(step.points, step.extrema(), step.deviationMm()));
    }
    return curves;
  }

  void offer(const std::vector<StructureCandidate>& curves, StructureCandidate& best) const {
    const int sketched = countedExtrema(setup_.original, setup_.closed, context_);
    for (const StructureCandidate& one : curves) {
      if (one.deviationMm <= most() && one.extrema < sketched && isFairerThan(one, best)) best = one;
    }
  }

  Result<FairedCurve> done(const StructureCandidate& found, std::optional<double> needed = {}) {
    FairingReport report;
    const int sketched = countedExtrema(setup_.original, setup_.closed, context_);
    report.why = found.deviationMm > 0.0 ? Termination::Converged : Termination::FixedPoint;
    if (found.deviationMm == 0.0 && sketched > 0 && params_.keptAt.empty() && !params_.keepExtrema.count)
      report.note = "No extremum can be removed within the tolerance." + heldEndsNote(sketched - 1);
    report.iterations = iterations_ + candidates_.iterations();
    report.neededMm = toleranceFor(needed.value_or(found.deviationMm));
    return asFaired(setup_, found, std::move(report));
  }

  bool hasHeldEnds() const {
    const EndHold free;
    return !setup_.closed && (params_.startHold != free || params_.endHold != free);
  }

  /// As they were given: what is claimed of the tolerance comes off anew where a curve is faired with them.
  FairingParams paramsGiven() const {
    FairingParams given = params_;
    given.toleranceMm += setup_.claimedMm();
    return given;
  }

  /// With held ends, what so many extrema would take; it may be that no tolerance is enough.
  std::string heldEndsNote(int extrema) const {
    FairingParams one = paramsGiven();
    one.keepExtrema.count = extrema;
    if (!hasHeldEnds() || validate(one)) return {};
    const auto asked = fairMonotone(setup_.original, setup_.closed, one, context_);
    return asked && !asked->report.withinTolerance ? ' ' + asked->report.note : std::string();
  }

  /// [mm] What the extrema that are asked for would take if no end were held.
  std::optional<double> neededWithFreeEnds() const {
    if (!hasHeldEnds() || context_.isCancelled()) return std::nullopt;
    FairingParams free = paramsGiven();
    free.startHold = free.endHold = {};
    const auto faired = fairMonotone(setup_.original, setup_.closed, free, context_);
    if (!faired || !(faired->report.neededMm.value_or(0.0) > 0.0)) return std::nullopt;
    return faired->report.neededMm;
  }

  Result<FairedCurve> limited(const StructureCandidate& best, std::optional<double> needed) {
    auto result = done(best);
    if (!result) return result;
    FairingReport& report = result->report;
    const std::string kept = counted(report.extremaAfter, "extremum was kept.", "extrema were kept.");
    // By place, or by number: as few as can be are never too few.
    constexpr int kLeastOfClosed = 4;
    const bool byCount = params_.keptAt.empty() && params_.keepExtrema.count.has_value();
    const int count = byCount ? *params_.keepExtrema.count : kLeastOfClosed;
    const std::string asked = byCount ? extremaText(count) : "these extrema";
    report.why = needed ? Termination::ToleranceLimited : Termination::NoProgress;
    report.withinTolerance = false;
    report.neededMm.reset();
    if (needed) report.neededMm = toleranceFor(*needed);
    report.note = needed ? "A curve with " + asked + " needs a tolerance of " +
                               millimetres(*report.neededMm + setup_.claimedMm()) + "; " + kept
                         : "No curve with " + asked + " was found; " + kept;
    if (!needed && setup_.closed && count < kLeastOfClosed)
      report.note = "A closed curve has at least 4 curvature extrema, unless it is a circle; " + kept;
    if (const auto free = needed ? std::nullopt : neededWithFreeEnds())
      report.note = "No curve with " + asked +
                    " keeps what is held at the ends; with free ends it needs a tolerance of " + millimetres(*free) +
                    "; " + kept;
    return result;
  }

  const FairingSetup& setup_;
  const FairingParams& params_;
  const RunContext& context_;
  StructureCandidates candidates_;
  int iterations_ = 0;
};

}  // namespace

Result<FairedCurve> fairMonotone(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                 const RunContext& context) {
  return withSetup(curve, closed, params, context,
                   [&](const std::shared_ptr<const FairingSetup>& setup, const FairingParams& within) {
                     return MonotoneFairing(setup, within, context).run();
                   });
}

}  // namespace batten
