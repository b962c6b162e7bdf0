// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_line.h"
#include "core/fairing/profile/target_degrees.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// Smallest integral of (dkappa/ds)^2 with the deviation bounded by the tolerance, as the policy of the parameters says
/// (tolerance_fairing.h, fair_as_needed.h).
Result<FairedCurve> fairWithinTolerance(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&,
                                        const FairingLine& line = {});

/// All targets with their faired curves: what the target strip shows. Entries without value failed; the profile's
/// `problem` or the error says why.
struct TargetOutcomes {
  TargetSet targets;
  FairedByDegree faired;
  PerTarget<std::string> problems;
  /// degreeToRecommend() of the curves; where there is none, the one that TargetSet recommends. Absent: none.
  std::optional<int> recommendedDegree;
  std::vector<double> splits;       ///< Shares of the arc length at which the polynomials meet.
  std::optional<ProfileSpan> span;  ///< The span that alone was moved; absent: the whole curve.
};
Result<TargetOutcomes> fairAllTargets(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&);

/// The same for several curves at once: all targets of all curves share the threads, the longest first.
struct TargetsJob {
  NurbsCurve curve;
  bool closed = false;
  FairingParams params;
  std::optional<double> spanAt{};  ///< Share of the arc length: only the span there is moved. Absent: the whole curve.
};
std::vector<Result<TargetOutcomes>> fairAllTargets(std::span<const TargetsJob>, const RunContext&);

/// One call for every mode. FairingParams::means is the caller's business: here control points move.
Result<FairedCurve> fair(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&,
                         const FairingLine& line = {});

}  // namespace batten
