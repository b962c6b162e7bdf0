// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/profile/radius_target.h"

namespace batten {

/// The targets of one curve over one list of splits.
struct TargetLevel {
  std::vector<double> splits;
  TargetSet targets;
  bool isFiner = false;  ///< More splits than natural ones (naturalSplitLevels).
};

/// The targets over the splits that the parameters ask for; of natural spans over those of all levels, the natural
/// ones first. They do not depend on the tolerance. Never empty.
std::vector<TargetLevel> targetLevels(const NurbsCurve&, bool closed, const FairingParams&);

/// What one degree comes to.
struct LevelOutcome {
  std::size_t level = 0;  ///< Which of the levels gave it.
  FairedCurve faired;
  int tried = 1;  ///< Levels that were followed.
  /// The target was met within the tolerance without a curvature extremum more.
  bool isMet() const {
    return faired.report.withinTolerance && faired.report.extremaAfter <= faired.report.extremaBefore;
  }
};

/// The target of one degree is the one over the natural spans; where following it leaves more extrema than there are
/// splits, or changes the shape (kSensibleShare), the one over the first spans, fewer and fewer, of which that is not
/// true. What it needs (FairingReport::neededMm) does not depend on the tolerance. Of the curves of the levels that
/// were followed the one with the fewest extrema is taken, no fewer than there are splits of that one being looked for;
/// of these one that meets its target; of these the nearest to the sketch. More spans are followed only where too many
/// extrema are left. `onlyIfMet`: see ModificationEffort.
Result<LevelOutcome> fairOverLevels(const std::shared_ptr<const FairingSetup>&, std::span<const TargetLevel>,
                                    int degree, double toleranceMm, const RunContext&, bool onlyIfMet = false);

/// Target mode, the drawn profile excepted.
Result<FairedCurve> fairToTarget(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&);

}  // namespace batten
