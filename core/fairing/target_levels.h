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
};

/// The targets over the splits that the parameters ask for. Of natural spans also those of smaller tolerances, whose
/// curves are valid here too: fewest splits first. Never empty.
std::vector<TargetLevel> targetLevels(const NurbsCurve&, bool closed, const FairingParams&);

/// What one degree comes to.
struct LevelOutcome {
  std::size_t level = 0;  ///< Which of the levels gave it.
  FairedCurve faired;
  /// The target of the first level was met within the tolerance without a curvature extremum more.
  bool isMet() const {
    return level == 0 && faired.report.withinTolerance && faired.report.extremaAfter <= faired.report.extremaBefore;
  }
};

/// The level whose curve has the fewest extrema, of those the first: one that has no more than there are splits of the
/// first level ends the search. `onlyIfMet`: see ModificationEffort.
Result<LevelOutcome> fairOverLevels(const std::shared_ptr<const FairingSetup>&, std::span<const TargetLevel>,
                                    int degree, double toleranceMm, const RunContext&, bool onlyIfMet = false);

/// Target mode, the drawn profile excepted.
Result<FairedCurve> fairToTarget(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&);

}  // namespace batten
