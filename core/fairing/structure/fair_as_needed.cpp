// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/structure/fair_as_needed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_line.h"
#include "core/fairing/model/fairing_state.h"
#include "core/fairing/model/line_blocks.h"
#include "core/fairing/model/minimise.h"
#include "core/fairing/model/sketch_deviation.h"
#include "core/fairing/structure/monotone_search.h"
#include "core/fairing/structure/structure_candidates.h"

namespace batten {
namespace {

/// Cut-off waves are tried in these steps, from this many blocks or spans on.
constexpr double kWaveStep = 1.2;
constexpr double kShortestSpans = 2.0, kShortestBlocks = 4.0;  // of the shortest wave that is tried
/// Up to this many lengths of the curve: such a wave leaves no more than a straight line would.
constexpr double kLongestWave = 4.0;
/// Blocks that must be left over for the noise to be told from the misfit.
constexpr double kFewestOver = 6.0;
/// [costs of an extremum] A score worse than the best by more ends the search: longer waves only make it worse.
constexpr double kMuchWorse = 3.0;
/// What a degree of freedom has to be worth: 2 is Mallows' Cp; more, because noise of neighbours is never quite
/// independent.
constexpr double kDegreeCost = 3.0;
/// [chi2] Extrema go as long as the misfit rises by less than the first, and the second for each more.
constexpr double kExtremumCost = 20.0, kFurtherCost = 4.0;
/// To take a doubtful extremum away, moves up to so many standard deviations of a block are thought of, and of no less
/// than the second.
constexpr double kDoubtful = 4.0, kLeastMove = 0.3;
/// What the search for a simpler structure takes for a large move, in the same unit.
constexpr double kSearched = 16.0;
/// Iterations times control points that the search for a simpler structure may take: some seconds. Curves of a hundred
/// spans take less than half of it; those of many hundreds would take minutes, mostly in vain.
constexpr double kMostSearchWork = 1e5;
/// A smoothed curve that leaves the sketch by more, in the same unit, has lost it.
constexpr double kFarthest = 30.0;
/// [px^3] Density of the systematic error of edge points: less noise than this is not believed.
constexpr double kLeastDensity = 0.0064;
constexpr FairingLimits kLimits{15, 1e-4};  // [iterations, share of the objective]
/// Room for what lies between the places where the deviation is measured.
constexpr double kFairRoom = 0.998;

class NeededFairing {
 public:
  NeededFairing(const std::shared_ptr<const FairingSetup>& sketched, const FairingParams& params,
                const FairingLine& line, const RunContext& context)
      : sketched_(sketched), setup_(*sketched), params_(params), context_(context) {
    // The copy has a reference of its own: that of the original belongs to the original's basis.
    setup_.reference = SpanCurve(setup_.basis, setup_.points);
    blocks_ = lineBlocks(setup_, line);
    if (blocks_.areEnough()) setup_.offsets = blocks_.offsets(setup_);
    leastNoise_ = kLeastDensity * std::pow(line.pixelMm, 3.0) / std::max(blocks_.widthMm, 1e-300);
  }

  Result<FairedCurve> run() {
    const auto start = evaluate(setup_, objective_, {}, setup_.points, setup_.start.places);
    if (context_.isCancelled()) return cancelled();
    if (!start) {
      return unchanged(setup_.original, setup_.closed, Termination::Degenerate,
                       "The curve has a cusp and was not changed.");
    }
    report_.objectiveBefore = start->misfit;
    if (!(start->misfit * std::pow(setup_.start.length, 3.0) > 1e-12))
      return done({setup_.points, extremaOf(setup_.points), 0.0, 0.0});
    objective_.reference = std::sqrt(start->misfit);
    std::vector<Smoothed> found;
    if (!setup_.offsets.empty()) found = smoothedByNoise();
    if (context_.isCancelled()) return cancelled();
    if (found.empty()) return withoutLine();
    auto simpler = withoutDoubtfulExtrema(found.back());
    if (context_.isCancelled()) return cancelled();
    if (simpler) found.push_back(std::move(*simpler));
    // A sketch that is fairer than all of them, as the true and fair fit is, needs nothing.
    Smoothed best{setup_.points, extremaOf(setup_.points), 0.0, 0.0};
    for (Smoothed& one : found) {
      if (one.deviationMm <= kFairRoom * params_.toleranceMm && one.extrema <= best.extrema) best = std::move(one);
    }
    return done(std::move(best));
  }

 private:
  /// A curve that the line's noise allows.
  struct Smoothed {
    std::vector<Vec2> points;
    int extrema = 0;
    double deviationMm = 0.0, score = 0.0;
  };

  Result<FairedCurve> done(Smoothed best) {
    report_.why = best.points == setup_.points ? Termination::FixedPoint : Termination::Converged;
    FairingObjective plain;
    const auto after = evaluate(setup_, plain, {}, best.points, setup_.start.places);
    report_.objectiveAfter = after ? after->misfit : report_.objectiveBefore;
    return finished(setup_, std::move(best.points), params_.toleranceMm, report_);
  }

  Result<FairedCurve> withoutLine() {
    StructureCandidates candidates(sketched_, context_);
    if (!candidates.isValid()) return done({setup_.points, extremaOf(setup_.points), 0.0, 0.0});
    const StructureCandidate best = candidates.fewest(kFairRoom * params_.toleranceMm);
    if (context_.isCancelled()) return cancelled();
    report_.why = best.deviationMm > 0.0 ? Termination::Converged : Termination::FixedPoint;
    report_.iterations += candidates.iterations();
    return asFaired(setup_, best, report_);
  }

  int extremaOf(const std::vector<Vec2>& points) const {
    const auto curve = toCurve(setup_, points);
    if (!curve || !(setup_.extent > 0.0)) return std::numeric_limits<int>::max();
    return countedExtrema(*curve, setup_.closed, context_);
  }
  double shortestWave() const {
    const double span = setup_.start.length / setup_.basis.spanCount();
    return std::max(kShortestSpans * span, kShortestBlocks * blocks_.widthMm);
  }

  /// The curve whose waves shorter than this [mm] are gone: d^6 + mu d = mu y for small moves d, with mu = (2 pi /
  /// wave)^6.
  std::optional<FairingState> smoothed(double wave, const std::vector<Vec2>& points,
                                       const std::vector<SpanPlace>& feet) {
    const double weight =
        std::sqrt(setup_.start.length) * std::pow(2.0 * std::numbers::pi / wave, 3.0) / objective_.reference;
    const FairingCorridor corridor{.weight = weight};
    auto state = evaluate(setup_, objective_, corridor, points, feet);
    if (!state) return std::nullopt;
    FairingRun run = minimise(setup_, objective_, corridor, std::move(*state), kLimits, context_);
    report_.iterations += run.iterations;
    return std::move(run.state);
  }

  /// Degrees of freedom of such a curve: those of the smoothing spline of this order.
  double freedom(double wave) const {
    return std::min(3.0 + 2.0 * std::numbers::pi * setup_.start.length / (3.0 * wave), 1.0 * setup_.basis.pointCount());
  }

  /// The smoothed curves from the shortest wave to the one that the noise explains best, which comes last.
  std::vector<Smoothed> smoothedByNoise() {
    std::vector<Smoothed> found;
    std::size_t best = 0;
    const double count = static_cast<double>(blocks_.blocks.size());
    std::vector<Vec2> points = setup_.points;
    std::vector<SpanPlace> feet = setup_.start.places;
    for (double wave = shortestWave(); wave < kLongestWave * setup_.start.length && !context_.isCancelled();
         wave *= kWaveStep) {
      auto state = smoothed(wave, points, feet);
      if (!state) break;
      const double misfit = blocks_.misfit(setup_, *state), degrees = freedom(wave);
      if (!(noise_ > 0.0)) {
        if (count - degrees < kFewestOver) continue;
        noise_ = std::max(misfit / (count - degrees), leastNoise_);
      }
      const double score = misfit / noise_ + kDegreeCost * degrees,
                   away = largestDeviation(setup_, state->points, true);
      if (away <= kFarthest * std::sqrt(noise_)) {
        found.push_back({state->points, 0, away, score});
        if (score < found[best].score) best = found.size() - 1;
        if (score > found[best].score + kMuchWorse * kExtremumCost) break;
      }
      points = std::move(state->points);
      feet = state->feet();
    }
    if (noise_ > 0.0) report_.noiseMm = std::sqrt(noise_);
    if (!found.empty()) found.resize(best + 1);
    for (Smoothed& one : found) one.extrema = extremaOf(one.points);
    return found;
  }

  /// The misfit of the line's points in units of their noise.
  double misfitOf(const std::vector<Vec2>& points) const {
    const auto state = evaluate(setup_, objective_, {}, points, setup_.start.places);
    return state ? blocks_.misfit(setup_, *state) / noise_ : std::numeric_limits<double>::infinity();
  }

  std::optional<Smoothed> withoutDoubtfulExtrema(const Smoothed& start) {
    const auto curve = toCurve(setup_, start.points);
    if (!curve) return std::nullopt;
    const auto smooth = makeSetup(*curve, setup_.closed, params_, context_);
    if (!smooth || (*smooth)->points.size() != start.points.size()) return std::nullopt;
    const MonotoneSearch search(**smooth, kSearched * std::sqrt(noise_), context_);
    if (search.arcLength().empty()) return std::nullopt;
    const auto levels =
        structureLevels(search.arcLength(), search.curvature(), (*smooth)->start.length, setup_.closed, context_);
    const double before = misfitOf(start.points);
    // The estimates scale the problem: a vanishing one would make it stiff.
    const double least = kLeastMove * std::sqrt(noise_);
    std::optional<Smoothed> simpler;
    double work = 0.0;
    const auto mayGoOn = [&] { return work < kMostSearchWork && !context_.isCancelled(); };
    const auto attempt = [&](std::size_t level) {
      auto trial =
          search.solve(levels[level].structure, (*smooth)->points, std::max(levels[level].estimateMm, least), {});
      report_.iterations += trial.iterations;
      work += static_cast<double>(trial.iterations) * static_cast<double>(start.points.size());
      const double allowed = kExtremumCost + kFurtherCost * static_cast<double>(level - 1);
      const bool taken = trial.found && misfitOf(trial.points) < before + allowed;
      if (taken) simpler = Smoothed{std::move(trial.points), 0, 0.0, 0.0};
      return taken;
    };
    // From the simplest structure that noise could explain to more complicated ones, until one is near enough; then
    // back to simpler ones, as the estimate is only good to a factor of a few.
    std::size_t level = 0;
    while (level + 1 < levels.size() && levels[level + 1].estimateMm <= kDoubtful * std::sqrt(noise_)) ++level;
    std::size_t reached = 0;
    while (level > 0 && reached == 0 && mayGoOn()) {
      if (attempt(level)) reached = level;
      level -= std::max<std::size_t>(1, level / 6);
    }
    for (level = reached + 1; reached > 0 && level < levels.size() && mayGoOn(); ++level) {
      if (!attempt(level)) break;
    }
    if (work >= kMostSearchWork)
      report_.note =
          "The curve has too many segments to test every simpler curvature profile. Use fewer "
          "segments.";
    if (!simpler) return std::nullopt;
    simpler->extrema = extremaOf(simpler->points);
    simpler->deviationMm = largestDeviation(setup_, simpler->points, true);
    return simpler;
  }

  std::shared_ptr<const FairingSetup> sketched_;
  FairingSetup setup_;
  const FairingParams& params_;
  const RunContext& context_;
  LineBlocks blocks_;
  double leastNoise_ = 0.0, noise_ = 0.0;  ///< [mm^2] Of a block; the noise 0 until it is measured.
  FairingObjective objective_;
  FairingReport report_;
};

}  // namespace

Result<FairedCurve> fairAsNeeded(const std::shared_ptr<const FairingSetup>& setup, const FairingParams& params,
                                 const FairingLine& line, const RunContext& context) {
  return NeededFairing(setup, params, line, context).run();
}

}  // namespace batten
