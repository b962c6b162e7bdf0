// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/monotone_fairing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/number_text.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/fairing_setup.h"
#include "core/fairing/structure_candidates.h"
#include "core/fairing/target_steps.h"

namespace batten {
namespace {

/// The deviation is measured at places: it must keep this share of the tolerance.
constexpr double kKeptShare = 0.999;
/// Curves of more samples are not tried by targets: they are long and wavy, and each takes seconds.
constexpr int kMostTargetSamples = 600;

std::string millimetres(double mm) { return significantText(mm, 3) + " mm"; }

std::string extremaText(int count) {
  if (count == 0) return "monotone curvature";
  return count == 1 ? "1 curvature extremum" : std::to_string(count) + " curvature extrema";
}

class MonotoneFairing {
 public:
  MonotoneFairing(const std::shared_ptr<const FairingSetup>& setup, const FairingParams& params,
                  const RunContext& context)
      : setup_(*setup), params_(params), context_(context), candidates_(setup, context) {}

  Result<FairedCurve> run() {
    if (!candidates_.isValid()) {
      return unchanged(setup_.original, setup_.closed, Termination::Degenerate,
                       "The curve has a cusp and was not changed.");
    }
    const bool byPlace = !params_.keptAt.empty(), byCount = !byPlace && params_.keepExtrema != kKeepSignificant;
    std::optional<StructureCandidate> wanted;
    if (byPlace) wanted = candidates_.nearestWith(params_.keptAt);
    if (byCount) wanted = candidates_.nearest(params_.keepExtrema);
    if (context_.isCancelled()) return cancelled();
    if (wanted && isWithin(*wanted)) return done(std::move(*wanted));
    StructureCandidate best = candidates_.fewest(kKeptShare * params_.toleranceMm);
    const int fewest = byCount ? params_.keepExtrema : setup_.closed ? 4 : 0;
    if (!byPlace && best.extrema > fewest) byTargets(fewest, best, wanted);
    if (context_.isCancelled()) return cancelled();
    if ((!byPlace && !byCount) || (byCount && best.extrema <= params_.keepExtrema)) return done(std::move(best));
    return limited(wanted, std::move(best));
  }

 private:
  bool isWithin(const StructureCandidate& found) const { return found.deviationMm <= kKeptShare * params_.toleranceMm; }

  /// What a target reaches is to be had here too.
  void byTargets(int fewest, StructureCandidate& best, std::optional<StructureCandidate>& wanted) {
    if (setup_.sampleCount() > kMostTargetSamples) return;
    const TargetSet targets = fitTargets(setup_.original, params_.targets, setup_.closed);
    for (const TargetProfile& profile : targets.profiles) {
      const auto objective = targetObjective(setup_, profile);
      if (!objective) continue;
      const TargetSteps steps(setup_, *objective, context_);
      iterations_ += steps.iterations();
      for (const TargetStep& step : steps.all()) {
        StructureCandidate found{candidates_.sketch(), step.points, step.extrema, step.deviationMm};
        const bool better = found.extrema < best.extrema || (found.extrema == best.extrema && best.deviationMm > 0.0 &&
                                                             found.deviationMm < best.deviationMm);
        const bool nearer = found.extrema <= fewest && (!wanted || found.deviationMm < wanted->deviationMm);
        if (isWithin(found) && better) best = found;
        if (nearer) wanted = std::move(found);
      }
    }
  }

  Result<FairedCurve> done(StructureCandidate found) {
    FairingReport report;
    const int sketched = countedExtrema(setup_.original, setup_.closed);
    report.why = found.deviationMm > 0.0 ? Termination::Converged : Termination::FixedPoint;
    if (found.deviationMm == 0.0 && sketched > 0 && params_.keptAt.empty() && params_.keepExtrema == kKeepSignificant)
      report.note = "No extremum can be removed within the tolerance.";
    report.iterations = iterations_ + candidates_.iterations();
    report.neededMm = found.deviationMm;
    return asFaired(setup_, found, std::move(report));
  }

  Result<FairedCurve> limited(const std::optional<StructureCandidate>& wanted, StructureCandidate best) {
    auto result = done(std::move(best));
    if (!result) return result;
    FairingReport& report = result->report;
    const std::string kept = std::to_string(report.extremaAfter) + " extrema were kept.";
    const bool byPlace = !params_.keptAt.empty();
    const std::string asked = byPlace ? "these extrema" : extremaText(params_.keepExtrema);
    report.why = wanted ? Termination::ToleranceLimited : Termination::NoProgress;
    report.withinTolerance = false;
    report.neededMm = wanted ? wanted->deviationMm : 0.0;
    report.note =
        wanted ? "A curve with " + asked + " needs a tolerance of " + millimetres(wanted->deviationMm) + "; " + kept
               : "No curve with " + asked + " was found; " + kept;
    if (!wanted && setup_.closed && params_.keepExtrema < 4 && !byPlace)
      report.note = "A closed curve has at least 4 curvature extrema, unless it is a circle; " + kept;
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
