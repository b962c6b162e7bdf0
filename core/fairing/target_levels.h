// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// One list of splits.
struct TargetLevel {
  double fromMm = 0.0;         ///< The smallest tolerance that has these splits.
  std::vector<double> splits;  ///< 0..1 of the arc length, ascending.
};

/// The targets of one curve over the splits that the parameters ask for: of natural spans those of all tolerances,
/// fewest splits first. What is valid for a smaller tolerance is valid for a larger one too.
struct TargetLevels {
  std::vector<TargetLevel> all;  ///< Never empty.
  std::size_t first = 0;         ///< The one of the tolerance that is asked for.
  TargetSet targets;             ///< Over its splits.
  const TargetLevel& ofTolerance() const { return all[first]; }
  /// Over the splits of a level: fitted when it is asked for, where it is not the first one.
  TargetProfile profile(std::size_t level, int degree) const;

  NurbsCurve start;  ///< To which the others are fitted …
  TargetParams params;
  bool closed = false;  ///< … and how.
};
TargetLevels targetLevels(const NurbsCurve&, bool closed, const FairingParams&, CancelCheck check = {});
/// One list of splits, whatever the tolerance.
TargetLevels oneLevel(std::vector<double> splits, TargetSet targets);

/// What one degree comes to.
struct LevelOutcome {
  std::size_t level = 0;  ///< Which of the levels gave it.
  TargetProfile profile;  ///< The target over its splits.
  FairedCurve faired;
};

/// How far a degree is followed.
enum class LevelSearch {
  All,        ///< Over the spans of this tolerance and of smaller ones, for the fewest extrema.
  IfAllowed,  ///< The same, if the tolerance allows the whole target over the spans of one; else the sketch comes back.
};

/// The level whose curve has the fewest extrema, of those one that meets its target, of these the first: one that has
/// no more than there are splits of the tolerance's level ends the search.
///
/// Its `neededMm` is the smallest tolerance that meets the target over its own spans, or over those of a smaller one.
/// It does not depend on the tolerance; IfAllowed says it only where the target is allowed.
/// @param toleranceMm what fairing may take of the tolerance.
Result<LevelOutcome> fairOverLevels(const std::shared_ptr<const FairingSetup>&, const TargetLevels&, int degree,
                                    double toleranceMm, const RunContext&, LevelSearch search = LevelSearch::All);

}  // namespace batten
