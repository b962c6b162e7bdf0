// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/base/termination.h"
#include "core/curve/nurbs_curve.h"
#include "core/fairing/drawn_profile.h"
#include "core/fairing/radius_target.h"

namespace batten {

enum class FairingMode {
  None,       ///< The sketched curve as constructed.
  Target,     ///< Towards one of the six profiles, or the drawn one.
  Tolerance,  ///< Smallest integral of (dkappa/ds)^2 within the tolerance.
  Monotone,   ///< The nearest curve whose curvature is monotone between the extrema that are kept.
  LowPass,    ///< Towards the sketch's own curvature without its short waves.
};

/// How much of the tolerance the tolerance fairing uses.
enum class TolerancePolicy {
  AsNeeded,  ///< Until no wave is left that the line does not prove; see fairWithinTolerance.
  All,       ///< All of it: as even as the tolerance allows, whatever was drawn.
};

/// What a target or low-passed profile moves.
enum class FairingMeans {
  ControlPoints,  ///< All control points (000, 003).
  EdgeLengths,    ///< Bezier path: the lengths of the edges of each piece's polygon, not their directions (001).
};

/// FairingParams::target: the profile that the user has drawn.
inline constexpr int kDrawnTarget = 7;
/// FairingParams::keepExtrema: as few as the tolerance allows.
inline constexpr int kKeepSignificant = -1;

/// What is held at an end of an open curve beside its position, which always is.
struct EndHold {
  bool tangent = false;
  bool curvature = false;  ///< Includes the tangent: a held curvature on a turned end would join nothing.
  bool operator==(const EndHold&) const = default;
};

struct FairingParams {
  FairingMode mode = FairingMode::None;
  int target = 0;            ///< 0..7. Degree of the profile; 0 = the recommended one, 7 = the drawn one.
  double toleranceMm = 0.2;  ///< [mm] 0.001..20. Largest move of the curve from the sketched one; never exceeded.
  TolerancePolicy tolerancePolicy = TolerancePolicy::AsNeeded;  ///< Tolerance mode.
  FairingMeans means = FairingMeans::ControlPoints;  ///< Target and low-pass modes; edge lengths only on Bezier paths.
  double lowPassMm =
      20.0;  ///< [mm] 0.1..10000. Low-pass: waves of the curvature of this length are halved, shorter ones go.
  int keepExtrema =
      kKeepSignificant;        ///< Monotone: -1..99. Curvature extrema that may stay; -1 = those that must, see above.
  std::vector<double> keptAt;  ///< Monotone: arc length fractions 0..1 of the extrema to keep; not empty: counts alone.
  std::vector<ProfilePoint> profile;  ///< Target 7: the drawn curvature.
  EndHold startHold, endHold;
  TargetParams targets;
  bool operator==(const FairingParams&) const = default;
};
std::optional<Error> validate(const FairingParams&);

struct FairingReport {
  Termination why = Termination::NotRun;
  std::string note;  ///< For the user; empty when all went as asked.
  int iterations = 0;
  double objectiveBefore = 0.0, objectiveAfter = 0.0;  ///< Relative curvature misfit, or integral of (dkappa/ds)^2.
  double maxDeviationMm = 0.0;                         ///< From the sketched curve.
  double neededMm = 0.0;        ///< Target mode: deviation that meeting the target fully would take.
  bool withinTolerance = true;  ///< Target mode: the target was met within the tolerance.
  int extremaBefore = 0, extremaAfter = 0;
  double noiseMm = 0.0;  ///< Tolerance mode, as needed: standard deviation of a stretch of 8 px of the line's
                         ///< points; 0 = not known.
};
/// What is known of a line beside the curve that was made of it.
struct FairingLine {
  std::vector<Vec2>
      points;  ///< [mm] Measured, in order along the curve, without those that a corner falsifies. Empty: unknown.
  double pixelMm = 0.0;  ///< [mm] Size of a scan pixel.
};
struct FairedCurve {
  NurbsCurve curve;
  FairingReport report;
};

/// Moves the control points until the curvature follows the profile as far as the tolerance allows (000 VII, 003
/// section 4): Levenberg-Marquardt with the end points pinned in a null-space basis, fidelity weight by bisection.
/// Periodic curves stay periodic (`closed`). Knots stay as they are. Never returns a curve that leaves the tolerance.
Result<FairedCurve> modifyShape(const NurbsCurve&, bool closed, const TargetProfile&, const FairingParams&,
                                const RunContext&);

/// Smallest integral of (dkappa/ds)^2 with the deviation bounded by the tolerance.
/// TolerancePolicy::All: nothing else counts, and the whole tolerance is spent.
/// AsNeeded: the integral is weighed against the distance from the line's points. The weight is where the misfit of the
/// points is that of their own noise (Mallows' Cp); then curvature extrema go, cheapest first, as long as the misfit
/// rises by less than noise explains. Without points: the nearest curve with as few extrema as the whole tolerance
/// would give.
Result<FairedCurve> fairWithinTolerance(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&,
                                        const FairingLine& line = {});

/// All six targets with their faired curves: what the target strip shows. Entries without value failed; the profile's
/// `problem` or the error says why.
struct TargetOutcomes {
  TargetSet targets;
  std::array<std::optional<FairedCurve>, 6> faired;
  std::array<std::string, 6> problems;
  int recommendedDegree = 0;
};
Result<TargetOutcomes> fairAllTargets(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&);

/// The same for several curves at once: all targets of all curves share the threads, the longest first.
struct TargetsJob {
  NurbsCurve curve;
  bool closed = false;
  FairingParams params;
};
std::vector<Result<TargetOutcomes>> fairAllTargets(std::span<const TargetsJob>, const RunContext&);

/// One call for every mode. FairingParams::means is the caller's business: here control points move.
Result<FairedCurve> fair(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&,
                         const FairingLine& line = {});

}  // namespace batten
