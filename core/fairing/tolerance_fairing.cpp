// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/tolerance_fairing.h"

#include <algorithm>
#include <cmath>

#include "core/fairing/fairing_report.h"
#include "core/fairing/minimise.h"

namespace batten {
namespace {

/// The barrier ends at this share of the objective: the result is at most so much from the best one.
constexpr double kFinalGap = 1e-3;
constexpr double kBarrierStart = 0.3, kBarrierFactor = 0.2;
constexpr int kMaxIterations = 120;
/// Room between the barrier's bound at the samples and the tolerance, which holds between them too.
constexpr double kRoom = 0.998;
/// L^3 times the integral of (dkappa/ds)^2 below which nothing is left to improve.
constexpr double kPerfect = 1e-12;

}  // namespace

BoundedRun minimiseWithin(const FairingSetup& setup, const FairingObjective& objective, double toleranceMm,
                          const std::vector<Vec2>& points, const RunContext& context) {
  BoundedRun result;
  result.points = points;
  std::vector<SpanPlace> feet = setup.start.places;
  FairingCorridor corridor{0.0, kBarrierStart, kRoom * toleranceMm};
  if (const auto start = evaluate(setup, objective, {}, points, feet)) corridor.barrier *= start->misfit;
  double damping = 1e-3;
  while (result.iterations < kMaxIterations && !context.isCancelled()) {
    auto next = evaluate(setup, objective, corridor, result.points, feet);
    if (!next) break;
    const bool last = corridor.barrier <= kFinalGap * next->misfit;
    const FairingLimits limits = last ? FairingLimits{20, 1e-5} : FairingLimits{4, 1e-2};
    FairingRun run = minimise(setup, objective, corridor, std::move(*next), damping, limits, context);
    result.iterations += std::max(run.iterations, 1);
    damping = std::min(run.damping, 1e-3);
    result.points = std::move(run.state.points);
    feet = std::move(run.state.feet);
    if (last) {
      result.why = run.why;
      break;
    }
    corridor.barrier *= kBarrierFactor;
  }
  return result;
}

Result<FairedCurve> fairWithinTolerance(const FairingSetup& setup, double toleranceMm, const RunContext& context) {
  FairingObjective objective;
  auto state = evaluate(setup, objective, {}, setup.points, setup.start.places);
  if (!state) {
    return unchanged(setup.original, setup.closed, Termination::Degenerate, "The curve has a cusp and was left alone.");
  }
  FairingReport report;
  report.objectiveBefore = report.objectiveAfter = state->misfit;
  const double length = setup.start.length;
  if (!(state->misfit * length * length * length > kPerfect)) {
    return finished(setup, setup.points, toleranceMm, [&] {
      report.why = Termination::FixedPoint;
      return report;
    }());
  }
  objective.reference = std::sqrt(state->misfit);
  const BoundedRun run = minimiseWithin(setup, objective, toleranceMm, setup.points, context);
  if (context.isCancelled()) return cancelled();
  report.iterations = run.iterations;
  report.why = run.why;
  std::vector<Vec2> points = run.points;
  const double deviation = keepWithin(setup, toleranceMm, points);
  const auto after = evaluate(setup, objective, {}, points, setup.start.places);
  if (after) report.objectiveAfter = after->misfit * report.objectiveBefore;
  if (report.objectiveAfter > report.objectiveBefore) points = setup.points;
  report.objectiveAfter = std::min(report.objectiveAfter, report.objectiveBefore);
  if (deviation > 0.9 * toleranceMm && report.why != Termination::IterationLimit) {
    report.why = Termination::ToleranceLimited;
  }
  return finished(setup, std::move(points), toleranceMm, std::move(report));
}

}  // namespace batten
