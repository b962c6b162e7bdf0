// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/fairing.h"

#include <cmath>
#include <new>

#include "core/base/parallel.h"
#include "core/fairing/fairing_solvers.h"
#include "core/fairing/low_pass.h"
#include "core/fairing/monotone_fairing.h"

namespace batten {
namespace {

/// Extrema of a smaller rise (times extent) are not seen by an eye nor by light.
constexpr double kProminence = 5e-3;

int extremaOf(const NurbsCurve& curve, bool closed) {
  const double size = extent(curve);
  return size > 0.0 ? static_cast<int>(curvatureExtrema(curve, kProminence / size, closed).size()) : 0;
}

}  // namespace

Result<FairedCurve> withSetup(const NurbsCurve& curve, bool closed, const FairingParams& params,
                              const std::function<Result<FairedCurve>(const FairingSetup&)>& body) {
  if (const auto error = validate(params)) return fail(*error);
  try {
    const auto setup = makeSetup(curve, closed, params);
    if (setup) return body(**setup);
    if (setup.error().code != ErrorCode::Numerical) return fail(setup.error());
    return unchanged(curve, closed, Termination::Degenerate, setup.error().message);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to make the curve fair.");
  }
}

std::optional<Error> validate(const FairingParams& params) {
  if (!(params.toleranceMm >= 0.001 && params.toleranceMm <= 20.0)) {
    return Error{ErrorCode::BadParameter,
                 "The fairing tolerance must lie between 0.001 and 20 mm, not at " + std::to_string(params.toleranceMm) + ".",
                 {}};
  }
  if (params.target < 0 || params.target > kDrawnTarget) {
    return Error{ErrorCode::BadParameter,
                 "The fairing target must be 1 to 6, 0 for the recommended one or 7 for the drawn one, not " +
                     std::to_string(params.target) + ".",
                 {}};
  }
  if (!(params.lowPassMm >= 0.1 && params.lowPassMm <= 10000.0)) {
    return Error{ErrorCode::BadParameter,
                 "The wavelength of the low-pass must lie between 0.1 and 10000 mm, not at " +
                     std::to_string(params.lowPassMm) + ".",
                 {}};
  }
  if (params.keepExtrema < kKeepSignificant || params.keepExtrema > 99) {
    return Error{ErrorCode::BadParameter,
                 "The number of extrema to keep must be 0 to 99, or -1 for as few as possible, not " +
                     std::to_string(params.keepExtrema) + ".",
                 {}};
  }
  for (const double at : params.keptAt) {
    if (!(at >= 0.0 && at <= 1.0)) return Error{ErrorCode::BadParameter, "An extremum to keep lies beside the curve.", {}};
  }
  if (auto wrong = validateProfile(params.profile)) return wrong;
  return validate(params.targets);
}

FairedCurve unchanged(const NurbsCurve& curve, bool closed, Termination why, std::string note) {
  FairedCurve result;
  result.curve = curve;
  result.report.why = why;
  result.report.note = std::move(note);
  if (!curve.isEmpty()) result.report.extremaBefore = result.report.extremaAfter = extremaOf(curve, closed);
  return result;
}

Result<FairedCurve> finished(const FairingSetup& setup, std::vector<Vec2> points, double toleranceMm, FairingReport report) {
  report.maxDeviationMm = keepWithin(setup, toleranceMm, points);
  auto curve = toCurve(setup, points);
  if (!curve) return fail(curve.error());
  report.extremaBefore = extremaOf(setup.original, setup.closed);
  report.extremaAfter = extremaOf(*curve, setup.closed);
  return FairedCurve{std::move(*curve), std::move(report)};
}

Result<FairedCurve> modifyShape(const NurbsCurve& curve, bool closed, const TargetProfile& profile,
                                const FairingParams& params, const RunContext& context) {
  return withSetup(curve, closed, params, [&](const FairingSetup& setup) {
    return modifyShape(setup, profile, params.toleranceMm, context);
  });
}

Result<FairedCurve> fairWithinTolerance(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                        const RunContext& context) {
  return withSetup(curve, closed, params,
                   [&](const FairingSetup& setup) { return fairWithinTolerance(setup, params.toleranceMm, context); });
}

Result<TargetOutcomes> fairAllTargets(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                      const RunContext& context) {
  if (const auto error = validate(params)) return fail(*error);
  if (curve.isEmpty()) return fail(ErrorCode::BadParameter, "There is no curve to make fair.");
  try {
    TargetOutcomes outcomes;
    outcomes.targets = fitTargets(curve, params.targets, closed);
    outcomes.recommendedDegree = outcomes.targets.recommendedDegree;
    const auto setup = makeSetup(curve, closed, params);
    if (!setup && setup.error().code != ErrorCode::Numerical) return fail(setup.error());
    parallelFor(context, 6, 1, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (!setup) {
          outcomes.faired[at] = unchanged(curve, closed, Termination::Degenerate, setup.error().message);
          continue;
        }
        auto faired = modifyShape(**setup, outcomes.targets.profiles[at], params.toleranceMm, context);
        if (faired) {
          outcomes.faired[at] = std::move(*faired);
        } else {
          outcomes.problems[at] = faired.error().message;
        }
      }
    });
    if (context.isCancelled()) return cancelled();
    return outcomes;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to make the curve fair.");
  }
}

Result<FairedCurve> fair(const NurbsCurve& curve, bool closed, const FairingParams& params, const RunContext& context) {
  if (const auto error = validate(params)) return fail(*error);
  if (curve.isEmpty()) return fail(ErrorCode::BadParameter, "There is no curve to make fair.");
  switch (params.mode) {
    case FairingMode::None: return unchanged(curve, closed, Termination::NotRun, {});
    case FairingMode::Tolerance: return fairWithinTolerance(curve, closed, params, context);
    case FairingMode::Monotone: return fairMonotone(curve, closed, params, context);
    case FairingMode::LowPass: return fairByLowPass(curve, closed, params, context);
    case FairingMode::Target: break;
  }
  if (params.target == kDrawnTarget) {
    const TargetProfile drawn = drawnProfile(params.profile, closed);
    if (!drawn.valid) return unchanged(curve, closed, Termination::NotRun, drawn.problem);
    return modifyShape(curve, closed, drawn, params, context);
  }
  const TargetSet targets = fitTargets(curve, params.targets, closed);
  const int degree = params.target > 0 ? params.target : targets.recommendedDegree;
  if (degree == 0) {
    return unchanged(curve, closed, Termination::Degenerate, targets.profiles.front().problem);
  }
  const TargetProfile& profile = targets.profiles[static_cast<std::size_t>(degree - 1)];
  if (!profile.valid) return unchanged(curve, closed, Termination::Degenerate, profile.problem);
  return modifyShape(curve, closed, profile, params, context);
}

}  // namespace batten
