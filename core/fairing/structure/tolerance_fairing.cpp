// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/structure/tolerance_fairing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/curve/curvature.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/minimise.h"
#include "core/fairing/model/sketch_deviation.h"
#include "core/fairing/structure/structure_candidates.h"

namespace batten {
namespace {

/// The barrier ends at this share of the objective: the result is at most so much from the best one.
constexpr double kFinalGap = 1e-3;
// weight of the barrier, and what each round leaves of it
constexpr double kBarrierStart = 0.3, kBarrierFactor = 0.2;
constexpr int kMaxIterations = 120;  // of all rounds together; limits the work
/// Room between the barrier's bound at the samples and the tolerance, which holds between them too.
constexpr double kRoom = 0.998;
/// A distance that is bounded may be above the bound by this, for rounding.
constexpr double kRounding = 1.001;
/// Of the tolerance: a curve that uses more is limited by it.
constexpr double kUsedShare = 0.9;
/// With each weight of the barrier but the last, a few steps: the next one moves the curve again.
constexpr FairingLimits kOnTheWay{4, 1e-2}, kLast{20, 1e-5};
constexpr double kFirstDamping = 1e-3;  // no weight begins with more than the first one
/// L^3 times the integral of (dkappa/ds)^2 below which nothing is left to improve.
constexpr double kPerfect = 1e-12;

double unevennessOf(const StructureCandidate& curve) {
  const auto state = evaluate(*curve.setup, {}, {}, curve.points, curve.setup->start.places);
  return state ? state->misfit : std::numeric_limits<double>::infinity();
}

/// The most even of the curves with the fewest extrema.
struct SmoothestCurve {
  StructureCandidate best;
  double toleranceMm;
  const RunContext& context;
  Termination why = Termination::FixedPoint;
  int iterations = 0;

  /// Offers what the objective reaches from a curve.
  void offerFrom(StructureCandidate from) {
    const double unevenness = unevennessOf(best), reference = unevennessOf(from);
    if (!std::isfinite(reference)) return;
    FairingObjective objective;
    objective.reference = std::sqrt(reference);
    const bool isSketch = !from.setup->sketch;
    const FairingSetup& setup = *from.setup;
    BoundedRun run = minimiseWithin(setup, objective, toleranceMm, from.points, context);
    iterations += run.iterations;
    from.points = std::move(run.points);
    from.deviationMm =
        isSketch ? keepWithin(setup, toleranceMm, from.points) : largestDeviation(setup, from.points, true);
    const auto curve = toCurve(setup, from.points);
    if (!curve || from.deviationMm > kRoom * toleranceMm * kRounding) return;
    from.extrema = countedExtrema(*curve, setup.closed, setup.check);
    if (from.extrema != best.extrema || !(unevennessOf(from) < unevenness)) return;
    why = run.why;
    if (from.deviationMm > kUsedShare * toleranceMm && why != Termination::IterationLimit)
      why = Termination::ToleranceLimited;
    best = std::move(from);
  }
};

}  // namespace

BoundedRun minimiseWithin(const FairingSetup& setup, const FairingObjective& objective, double toleranceMm,
                          const std::vector<Vec2>& points, const RunContext& context) {
  BoundedRun result;
  result.points = points;
  std::vector<SpanPlace> feet = setup.start.places;
  FairingCorridor::Barrier barrier{kBarrierStart, kRoom * toleranceMm};
  if (const auto start = evaluate(setup, objective, {}, points, feet)) barrier.weight *= start->misfit;
  double damping = kFirstDamping;
  while (result.iterations < kMaxIterations && !context.isCancelled()) {
    const FairingCorridor corridor{.barrier = barrier};
    auto next = evaluate(setup, objective, corridor, result.points, feet);
    if (!next) break;
    const bool last = barrier.weight <= kFinalGap * next->misfit;
    const FairingLimits limits = last ? FairingLimits{kLast.iterations, kLast.relativeDecrease, damping}
                                      : FairingLimits{kOnTheWay.iterations, kOnTheWay.relativeDecrease, damping};
    FairingRun run = minimise(setup, objective, corridor, std::move(*next), limits, context);
    result.iterations += std::max(run.iterations, 1);
    damping = std::min(run.damping, kFirstDamping);
    result.points = std::move(run.state.points);
    feet = run.state.feet();
    if (last) {
      result.why = run.why;
      break;
    }
    barrier.weight *= kBarrierFactor;
  }
  return result;
}

Result<FairedCurve> fairWithinTolerance(const std::shared_ptr<const FairingSetup>& setup, const FairingParams& params,
                                        const RunContext& context) {
  const auto state = evaluate(*setup, {}, {}, setup->points, setup->start.places);
  if (context.isCancelled()) return cancelled();
  if (!state) {
    return unchanged(setup->original, setup->closed, Termination::Degenerate,
                     "The curve has a cusp and was not changed.");
  }
  const double length = setup->start.length;
  if (!(state->misfit * length * length * length > kPerfect)) {
    FairingReport report;
    report.objectiveBefore = report.objectiveAfter = state->misfit;
    report.why = Termination::FixedPoint;
    return finished(*setup, setup->points, params.toleranceMm, std::move(report));
  }
  StructureCandidates candidates(setup, context);
  const StructureCandidate sketch{setup, setup->points, countedExtrema(setup->original, setup->closed, setup->check),
                                  0.0};
  SmoothestCurve smoothest{candidates.isValid() ? candidates.fewest(kRoom * params.toleranceMm) : sketch,
                           params.toleranceMm, context};
  if (smoothest.best.setup != setup || smoothest.best.deviationMm > 0.0) smoothest.offerFrom(smoothest.best);
  smoothest.offerFrom(sketch);
  if (context.isCancelled()) return cancelled();
  FairingReport report;
  report.why = smoothest.why;
  report.iterations = smoothest.iterations + candidates.iterations();
  return asFaired(*setup, smoothest.best, std::move(report));
}

}  // namespace batten
