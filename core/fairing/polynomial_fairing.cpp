// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/polynomial_fairing.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/profile/target_degrees.h"
#include "core/fairing/profile/target_profiles.h"
#include "core/fairing/recommended_degree.h"
#include "core/fairing/target/span_fairing.h"
#include "core/fairing/target_levels.h"
#include "core/fairing/target_splits.h"

namespace batten {
namespace {

/// The degree that the parameters ask for, and its curve.
class DegreeChoice {
 public:
  DegreeChoice(const std::shared_ptr<const FairingSetup>& setup, const TargetLevels& levels,
               const FairingParams& params, const RunContext& context)
      : setup_(setup), levels_(levels), params_(params), context_(context) {}

  Result<FairedCurve> chosen() {
    if (const std::optional<int> asked = degreeOf(params_.target)) return toDegree(*asked, LevelSearch::All);
    const bool bySimilarity = params_.targetChoice == TargetChoice::Similarity;
    for (int degree = 1; degree <= kMostTargetDegree; ++degree) {
      if (!levels_.targets.profiles[degree - 1].valid) continue;
      if (const auto error = add(degree, bySimilarity ? LevelSearch::All : LevelSearch::IfAllowed)) return fail(*error);
    }
    const int nearest = *levels_.targets.recommendedDegree;
    const auto isMet = [](const auto& one) { return one && one->report.withinTolerance; };
    if (!bySimilarity && std::none_of(faired_.begin(), faired_.end(), isMet))
      if (const auto error = add(nearest, LevelSearch::All)) return fail(*error);
    const auto best = degreeToRecommend(faired_, nearest, params_);
    // Without any S the one that fits the sketch best, as its tile says.
    return std::move(*faired_[best.value_or(nearest) - 1]);
  }

 private:
  Result<FairedCurve> toDegree(int degree, LevelSearch search) const {
    auto outcome = fairOverLevels(setup_, levels_, degree, params_.toleranceMm, context_, search);
    if (!outcome) return fail(outcome.error());
    outcome->faired.report.targetDegree = degree;
    outcome->faired.report.targetSplits = levels_.all[outcome->level].splits;
    return std::move(outcome->faired);
  }
  std::optional<Error> add(int degree, LevelSearch search) {
    auto faired = toDegree(degree, search);
    if (!faired) return faired.error();
    faired_[degree - 1] = std::move(*faired);
    return std::nullopt;
  }

  const std::shared_ptr<const FairingSetup>& setup_;
  const TargetLevels& levels_;
  const FairingParams& params_;
  const RunContext& context_;
  FairedByDegree faired_;
};

}  // namespace

Result<FairedCurve> fairToTarget(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                 const RunContext& context) {
  if (!params.spanTargets.empty())
    return fairSpans(curve, closed, targetSplits(curve, closed, params, context), params, context);
  const TargetLevels levels = targetLevels(curve, closed, params, context);
  const TargetSet& first = levels.targets;
  if (!first.recommendedDegree)
    return unchanged(curve, closed, Termination::Degenerate, first.profiles.front().problem);
  if (const auto asked = degreeOf(params.target)) {
    const TargetProfile& profile = first.profiles[*asked - 1];
    if (!profile.valid) return unchanged(curve, closed, Termination::Degenerate, profile.problem);
  }
  return withSetup(curve, closed, params, context, [&](const auto& setup, const FairingParams& within) {
    return DegreeChoice(setup, levels, within, context).chosen();
  });
}

}  // namespace batten
