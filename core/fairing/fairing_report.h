// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/termination.h"
#include "core/curve/nurbs_curve.h"
#include "core/fairing/profile/target_degrees.h"

namespace batten {

/// A log-aesthetic stretch of a target (log_aesthetic.h).
struct LogAestheticSpan {
  double from = 0.0, to = 1.0;  ///< Shares of the arc length; closed: `to` may lie beyond 1.
  double alpha = 0.0;           ///< [-] Power of the radius, see LogAesthetic.
  /// [-] Miura's Lambda for a radius of 1 at its start: rho^alpha = 1 + alpha Lambda s (alpha 0: rho = e^(Lambda s)).
  /// 0 where a stretch begins or ends straight, or is a circle.
  double lambda = 0.0;
  std::optional<double> startRadiusMm = {}, endRadiusMm = {};  ///< Signed; absent: straight there.
};

struct FairingReport {
  Termination why = Termination::NotRun;
  std::string note;                                    ///< For the user; empty when all went as asked.
  int iterations = 0;                                  ///< Of all minimisations together.
  double objectiveBefore = 0.0, objectiveAfter = 0.0;  ///< Relative curvature misfit, or integral of (dkappa/ds)^2.
  double maxDeviationMm = 0.0;                         ///< From the sketched curve.
  /// The smallest tolerance that meets the target (fairOverLevels), or takes the extrema that are too many; absent: the
  /// mode knows none, or none does.
  std::optional<double> neededMm;
  bool withinTolerance = true;  ///< Target mode: the target was met within the tolerance.
  /// Target mode with polynomials: the degree of the one that was followed, and the shares of the arc length at which
  /// its parts meet; absent: none. Parts between corners that followed different degrees: absent.
  std::optional<int> targetDegree;
  std::vector<double> targetSplits;
  /// Target mode: S (003 section 6) of the faired curve against the sketched one (similarityToSketch).
  std::optional<double> similarityAfter;
  std::vector<LogAestheticSpan> logAesthetic;  ///< Target 8: what the curve was fitted to.
  int extremaBefore = 0, extremaAfter = 0;     ///< Of the usual prominence.
  double roundedMm = 0.0;  ///< Largest distance that rounding its corners moved the faired curve; not in the figures
                           ///< above, which are of fairing alone.
  /// Tolerance mode, as needed: standard deviation of a stretch of 8 px of the line's points; absent: not known.
  std::optional<double> noiseMm;
};

struct FairedCurve {
  NurbsCurve curve;
  FairingReport report;
};

/// The curve as sketched, with the reason why nothing was done. Cancelled: the extrema are not counted.
FairedCurve unchanged(const NurbsCurve& curve, bool closed, Termination why, std::string note, CancelCheck check = {});

/// The targets of one curve made fair; absent where one failed.
using FairedByDegree = PerTarget<std::optional<FairedCurve>>;

/// Adds a sentence that is not there yet.
void addSentence(std::string& notes, const std::string& note);

/// What the fairing of one more part of the curve adds to the report of the whole: the worst of both; no tolerance is
/// enough for the whole where none is for a part. The extrema, which do not add up, are the caller's business.
void addPart(FairingReport& sum, const FairingReport& part);

}  // namespace batten
