// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/fair_as_needed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing_line.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/fairing_state.h"
#include "core/fairing/line_blocks.h"
#include "core/fairing/minimise.h"
#include "core/fairing/monotone_search.h"
#include "core/fairing/tolerance_fairing.h"

namespace batten {
namespace {

/// Cut-off waves are tried in these steps, from this many blocks or spans on.
constexpr double kWaveStep = 1.2;
constexpr double kShortestSpans = 2.0, kShortestBlocks = 4.0;
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
/// [px^3] Density of the systematic error of edge points: less noise than this is not believed.
constexpr double kLeastDensity = 0.0064;
constexpr FairingLimits kLimits{15, 1e-4};
/// Room for what lies between the places where the deviation is measured.
constexpr double kFairRoom = 0.998;

class NeededFairing {
 public:
  NeededFairing(const FairingSetup& sketched, const FairingParams& params, const FairingLine& line,
                const RunContext& context)
      : setup_(sketched), params_(params), context_(context) {
    // The copy has a reference of its own: that of the original belongs to the original's basis.
    setup_.reference = SpanCurve(setup_.basis, setup_.points);
    blocks_ = lineBlocks(setup_, line);
    if (blocks_.areEnough()) setup_.offsets = blocks_.offsets(setup_);
    leastNoise_ = kLeastDensity * std::pow(line.pixelMm, 3.0) / std::max(blocks_.widthMm, 1e-300);
  }

  Result<FairedCurve> run() {
    const auto start = evaluate(setup_, objective_, {}, setup_.points, setup_.start.places);
    if (!start) {
      return unchanged(setup_.original, setup_.closed, Termination::Degenerate,
                       "The curve has a cusp and was left alone.");
    }
    report_.objectiveBefore = start->misfit;
    if (!(start->misfit * std::pow(setup_.start.length, 3.0) > 1e-12))
      return done(setup_.points, Termination::FixedPoint);
    objective_.reference = std::sqrt(start->misfit);
    const bool known = !setup_.offsets.empty();
    const auto smooth = known ? smoothestWithinNoise() : nearestOfFewestExtrema();
    if (context_.isCancelled()) return cancelled();
    if (!smooth) return fairWithinTolerance(setup_, params_.toleranceMm, context_);
    std::vector<Vec2> points = known ? withoutDoubtfulExtrema(*smooth) : *smooth;
    if (context_.isCancelled()) return cancelled();
    // A sketch that is fairer than that, as the true and fair fit is, needs nothing.
    if (extremaOf(points) > extremaOf(setup_.points)) return done(setup_.points, Termination::FixedPoint);
    return done(std::move(points), Termination::Converged);
  }

 private:
  Result<FairedCurve> done(std::vector<Vec2> points, Termination why) {
    report_.why = why;
    FairingObjective plain;
    const auto after = evaluate(setup_, plain, {}, points, setup_.start.places);
    report_.objectiveAfter = after ? after->misfit : report_.objectiveBefore;
    return finished(setup_, std::move(points), params_.toleranceMm, report_);
  }

  int extremaOf(const std::vector<Vec2>& points) const {
    const auto curve = toCurve(setup_, points);
    if (!curve || !(setup_.extent > 0.0)) return std::numeric_limits<int>::max();
    return static_cast<int>(curvatureExtrema(*curve, kExtremumProminence / setup_.extent, setup_.closed).size());
  }
  bool isWithin(const std::vector<Vec2>& points) const {
    return largestDeviation(setup_, points, true) <= kFairRoom * params_.toleranceMm;
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
    const FairingCorridor corridor{weight, 0.0, 0.0};
    auto state = evaluate(setup_, objective_, corridor, points, feet);
    if (!state) return std::nullopt;
    FairingRun run = minimise(setup_, objective_, corridor, std::move(*state), 1e-3, kLimits, context_);
    report_.iterations += run.iterations;
    return std::move(run.state);
  }

  /// Degrees of freedom of such a curve: those of the smoothing spline of this order.
  double freedom(double wave) const {
    return std::min(3.0 + 2.0 * std::numbers::pi * setup_.start.length / (3.0 * wave), 1.0 * setup_.basis.pointCount());
  }

  std::optional<std::vector<Vec2>> smoothestWithinNoise() {
    std::optional<std::vector<Vec2>> best;
    double bestScore = 0.0;
    const double count = static_cast<double>(blocks_.blocks.size());
    std::vector<Vec2> points = setup_.points;
    std::vector<SpanPlace> feet = setup_.start.places;
    for (double wave = shortestWave(); wave < 4.0 * setup_.start.length && !context_.isCancelled(); wave *= kWaveStep) {
      auto state = smoothed(wave, points, feet);
      if (!state) break;
      const double misfit = blocks_.misfit(setup_, *state), degrees = freedom(wave);
      if (noise_ <= 0.0) {
        if (count - degrees < 6.0) continue;
        noise_ = std::max(misfit / (count - degrees), leastNoise_);
      }
      const double score = misfit / noise_ + kDegreeCost * degrees;
      if ((!best || score < bestScore) && isWithin(state->points)) {
        best = state->points;
        bestScore = score;
      }
      if (best && score > bestScore + 3.0 * kExtremumCost) break;
      points = std::move(state->points);
      feet = std::move(state->feet);
    }
    report_.noiseMm = std::sqrt(noise_);
    return best;
  }

  /// Without the line's points: no more extrema than when the whole tolerance is spent, as near to the sketch as that
  /// goes.
  std::optional<std::vector<Vec2>> nearestOfFewestExtrema() {
    const auto all = fairWithinTolerance(setup_, params_.toleranceMm, context_);
    if (!all) return std::nullopt;
    const int fewest = all->report.extremaAfter;
    if (extremaOf(setup_.points) <= fewest) return setup_.points;
    std::vector<Vec2> points = setup_.points;
    std::vector<SpanPlace> feet = setup_.start.places;
    for (double wave = shortestWave(); wave < 4.0 * setup_.start.length && !context_.isCancelled(); wave *= kWaveStep) {
      auto state = smoothed(wave, points, feet);
      if (!state || !isWithin(state->points)) return std::nullopt;
      if (extremaOf(state->points) <= fewest) return state->points;
      points = std::move(state->points);
      feet = std::move(state->feet);
    }
    return std::nullopt;
  }

  /// The misfit of the line's points in units of their noise.
  double misfitOf(const std::vector<Vec2>& points) const {
    const auto state = evaluate(setup_, objective_, {}, points, setup_.start.places);
    return state ? blocks_.misfit(setup_, *state) / noise_ : std::numeric_limits<double>::infinity();
  }

  std::vector<Vec2> withoutDoubtfulExtrema(std::vector<Vec2> points) {
    const auto curve = toCurve(setup_, points);
    if (!curve) return points;
    const auto smooth = makeSetup(*curve, setup_.closed, params_);
    if (!smooth || (*smooth)->points.size() != points.size()) return points;
    const MonotoneSearch search(**smooth, std::min(params_.toleranceMm, kSearched * std::sqrt(noise_)), context_);
    if (search.arcLength().empty()) return points;
    const auto levels = structureLevels(search.arcLength(), search.curvature(), (*smooth)->start.length, setup_.closed);
    const double before = misfitOf(points);
    // The estimates scale the problem: a vanishing one would make it stiff.
    const double least = kLeastMove * std::sqrt(noise_);
    const auto attempt = [&](std::size_t level) {
      auto trial = search.solve(levels[level].structure, (*smooth)->points, std::max(levels[level].estimateMm, least),
                                0.0, params_.toleranceMm);
      report_.iterations += trial.iterations;
      const double allowed = kExtremumCost + kFurtherCost * static_cast<double>(level - 1);
      const bool taken = trial.found && isWithin(trial.points) && misfitOf(trial.points) < before + allowed;
      if (taken) points = std::move(trial.points);
      return taken;
    };
    // From the simplest structure that noise could explain to more complicated ones, until one is near enough; then
    // back to simpler ones, as the estimate is only good to a factor of a few.
    std::size_t level = 0;
    while (level + 1 < levels.size() && levels[level + 1].estimateMm <= kDoubtful * std::sqrt(noise_)) ++level;
    std::size_t reached = 0;
    while (level > 0 && reached == 0 && !context_.isCancelled()) {
      if (attempt(level)) reached = level;
      level -= std::max<std::size_t>(1, level / 6);
    }
    for (level = reached + 1; reached > 0 && level < levels.size() && !context_.isCancelled(); ++level) {
      if (!attempt(level)) break;
    }
    return points;
  }

  FairingSetup setup_;
  const FairingParams& params_;
  const RunContext& context_;
  LineBlocks blocks_;
  double leastNoise_ = 0.0, noise_ = 0.0;  ///< [mm^2] Of a block.
  FairingObjective objective_;
  FairingReport report_;
};

}  // namespace

Result<FairedCurve> fairAsNeeded(const FairingSetup& setup, const FairingParams& params, const FairingLine& line,
                                 const RunContext& context) {
  return NeededFairing(setup, params, line, context).run();
}

}  // namespace batten
