// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/monotone_fairing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/number_text.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/fairing_setup.h"
#include "core/fairing/fairing_state.h"
#include "core/fairing/monotone_search.h"

namespace batten {
namespace {

/// The distance is bounded at the samples by the first share of the tolerance, and must keep the second between them
/// too.
constexpr double kBoundShare = 0.985, kKeptShare = 0.999;
/// A nearest curve (in the mean) that lies farther off than so many tolerances is not tried with the bound.
constexpr double kWorthBounding = 6.0;

std::string millimetres(double mm) { return significantText(mm, 3) + " mm"; }

std::string extremaText(int count) {
  if (count == 0) return "monotone curvature";
  return count == 1 ? "1 curvature extremum" : std::to_string(count) + " curvature extrema";
}

int sizeOf(const StructureLevel& level) { return static_cast<int>(level.structure.extrema.size()); }

/// What came of trying one structure.
struct Attempt {
  std::vector<Vec2> points;
  bool attained = false;
  bool found = false;     ///< A curve of this structure exists, within the tolerance or not.
  double neededMm = 0.0;  ///< Its distance from the sketch.
};

class MonotoneFairing {
 public:
  MonotoneFairing(const FairingSetup& setup, const FairingParams& params, const RunContext& context)
      : setup_(setup), params_(params), context_(context), search_(setup, params.toleranceMm, context) {}

  Result<FairedCurve> run() {
    if (search_.arcLength().empty()) {
      return unchanged(setup_.original, setup_.closed, Termination::Degenerate,
                       "The curve has a cusp and was left alone.");
    }
    levels_ = structureLevels(search_.arcLength(), search_.curvature(), setup_.start.length, setup_.closed);
    std::optional<Attempt> wanted;
    int wantedCount = 0;
    std::size_t simplest = levels_.size() - 1;
    if (!params_.keptAt.empty()) {
      const CurvatureStructure chosen = chosenStructure();
      wantedCount = static_cast<int>(chosen.extrema.size());
      wanted = attempt(chosen, levels_.back().estimateMm);
    } else if (params_.keepExtrema != kKeepSignificant) {
      simplest = levelOf(params_.keepExtrema);
      wantedCount = sizeOf(levels_[simplest]);
      if (simplest > 0) wanted = attempt(levels_[simplest].structure, levels_[simplest].estimateMm);
    }
    if (context_.isCancelled()) return cancelled();
    if (wanted && wanted->attained)
      return done(std::move(wanted->points), Termination::Converged, {}, wanted->neededMm, true);
    Attempt best = fewest(simplest, wanted.has_value());
    if (context_.isCancelled()) return cancelled();
    if (!wanted) {
      const bool nothing = best.points == setup_.points && levels_.size() > 1;
      return done(std::move(best.points), Termination::Converged,
                  nothing ? "No extremum can be taken away within the tolerance." : "", best.neededMm, true);
    }
    return limited(*wanted, wantedCount, std::move(best));
  }

 private:
  CurvatureStructure chosenStructure() const {
    std::vector<int> samples;
    for (const double f : params_.keptAt) {
      const auto& s = search_.arcLength();
      const auto above = std::lower_bound(s.begin(), s.end(), f * setup_.start.length);
      samples.push_back(static_cast<int>(std::min(above, s.end() - 1) - s.begin()));
    }
    return structureAt(search_.curvature(), levels_.front().structure, samples, setup_.closed);
  }

  /// The first level that has no more extrema than asked for.
  std::size_t levelOf(int count) const {
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      if (sizeOf(levels_[i]) <= count) return i;
    }
    return levels_.size() - 1;
  }

  /// @param giveUpMm where not 0, a curve farther off than this is of no interest.
  Attempt attempt(const CurvatureStructure& structure, double estimateMm, double giveUpMm = 0.0) {
    const double tolerance = params_.toleranceMm;
    MonotoneSearch::Outcome outcome = search_.solve(structure, setup_.points, estimateMm, 0.0, giveUpMm);
    iterations_ += outcome.iterations;
    Attempt result{std::move(outcome.points), false, outcome.found, outcome.deviationMm};
    if (!outcome.found || context_.isCancelled()) return result;
    result.attained = outcome.deviationMm <= kKeptShare * tolerance;
    if (result.attained || outcome.deviationMm > kWorthBounding * tolerance) return result;
    MonotoneSearch::Outcome bounded = search_.solve(structure, result.points, tolerance, kBoundShare * tolerance, 0.0);
    iterations_ += bounded.iterations;
    if (!bounded.found || bounded.deviationMm > kKeptShare * tolerance) return result;
    return {std::move(bounded.points), true, true, bounded.deviationMm};
  }

  /// The simplest structure up to a level that keeps the tolerance: by bisection, for simpler ones lie farther off.
  Attempt fewest(std::size_t simplest, bool simplestFails) {
    Attempt best{setup_.points, true, true, 0.0};
    std::size_t inside = 0, outside = simplest + (simplestFails ? 0 : 1);
    // The estimate is good to a factor of a few: it saves most of the bisection.
    std::size_t next = inside;
    while (next + 1 < outside && levels_[next + 1].estimateMm <= params_.toleranceMm) ++next;
    while (inside + 1 < outside && !context_.isCancelled()) {
      next = std::clamp(next, inside + 1, outside - 1);
      Attempt trial = attempt(levels_[next].structure, levels_[next].estimateMm, kWorthBounding * params_.toleranceMm);
      if (trial.attained) {
        inside = next;
        best = std::move(trial);
        next = inside + std::max<std::size_t>(1, (outside - inside) / 4);
      } else {
        outside = next;
        next = inside + (outside - inside) / 2;
      }
    }
    return best;
  }

  Result<FairedCurve> done(std::vector<Vec2> points, Termination why, std::string note, double neededMm, bool within) {
    FairingReport report;
    report.why = points == setup_.points ? Termination::FixedPoint : why;
    report.note = std::move(note);
    report.iterations = iterations_;
    report.neededMm = neededMm;
    report.withinTolerance = within;
    const FairingObjective even;
    const auto before = evaluate(setup_, even, {}, setup_.points, setup_.start.places);
    const auto after = evaluate(setup_, even, {}, points, setup_.start.places);
    report.objectiveBefore = before ? before->misfit : 0.0;
    report.objectiveAfter = after ? after->misfit : report.objectiveBefore;
    return finished(setup_, std::move(points), params_.toleranceMm, std::move(report));
  }

  Result<FairedCurve> limited(const Attempt& wanted, int wantedCount, Attempt best) {
    const Termination why = wanted.found ? Termination::ToleranceLimited : Termination::NoProgress;
    auto result = done(std::move(best.points), why, {}, wanted.found ? wanted.neededMm : 0.0, false);
    if (!result) return result;
    const std::string asked = extremaText(wantedCount), kept = std::to_string(result->report.extremaAfter);
    result->report.why = why;
    result->report.note = wanted.found ? "A curve with " + asked + " needs a tolerance of " +
                                             millimetres(wanted.neededMm) + "; " + kept + " extrema were kept."
                                       : "No curve near the sketch has " + asked + "; " + kept + " extrema were kept.";
    return result;
  }

  const FairingSetup& setup_;
  const FairingParams& params_;
  const RunContext& context_;
  MonotoneSearch search_;
  std::vector<StructureLevel> levels_;
  int iterations_ = 0;
};

}  // namespace

Result<FairedCurve> fairMonotone(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                 const RunContext& context) {
  return withSetup(curve, closed, params,
                   [&](const FairingSetup& setup) { return MonotoneFairing(setup, params, context).run(); });
}

}  // namespace batten
