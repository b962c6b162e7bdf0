// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target_levels.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/profile/target_degrees.h"
#include "core/fairing/target/calm_curve.h"
#include "core/fairing/target/natural_spans.h"
#include "core/fairing/target/shape_modification.h"

namespace batten {
namespace {

/// What is known of one level.
struct LevelState {
  std::optional<double> neededMm;         ///< The tolerance that meets the target.
  bool isTried = false;                   ///< And the curve for the tolerance is known.
  std::unique_ptr<TargetCourses> target;  ///< Of a level that was looked at.
  std::optional<TargetProfile> profile;   ///< Of the same.
};

/// One degree over the levels.
class LevelFairing {
 public:
  LevelFairing(const std::shared_ptr<const FairingSetup>& setup, const TargetLevels& levels, int degree,
               double toleranceMm, const RunContext& context)
      : setup_(setup),
        levels_(levels),
        degree_(degree),
        toleranceMm_(toleranceMm),
        context_(context),
        states_(levels.all.size()) {}

  Result<LevelOutcome> run(LevelSearch search) {
    if (search == LevelSearch::IfAllowed) {
      auto faired = modifyShape(targetOf(levels_.first), toleranceMm_, {.onlyIfMet = true});
      if (!faired) return fail(faired.error());
      keep(levels_.first, std::move(*faired));
      if (!best_->faired.report.withinTolerance) {
        if (!isAllowed()) return finished();
        best_.reset();  // to be followed as far as it goes
      }
    }
    const auto fewest = std::ssize(levels_.ofTolerance().splits);
    std::ptrdiff_t spans = best_ ? fewest : 0;  // of the levels looked at
    for (std::size_t i = levels_.first; i < levels_.all.size(); ++i) {
      const auto splits = std::ssize(levels_.all[i].splits);
      if (best_ && (splits > kMostSplits || best_->faired.report.extremaAfter <= fewest)) break;
      if (best_ && splits <= spans) continue;
      spans = splits;
      if (const auto error = tryLevel(i)) {
        if (!best_) return fail(*error);
        break;
      }
    }
    if (const auto met = findNeed()) meet(*met);
    return finished();
  }

 private:
  const TargetProfile& profileOf(std::size_t level) {
    auto& profile = states_[level].profile;
    if (!profile) profile = levels_.profile(level, degree_);
    return *profile;
  }
  TargetCourses& targetOf(std::size_t level) {
    auto& target = states_[level].target;
    if (!target) target = std::make_unique<TargetCourses>(setup_, profileOf(level), context_);
    return *target;
  }

  std::optional<Error> tryLevel(std::size_t level) {
    auto faired = modifyShape(targetOf(level), toleranceMm_);
    if (!faired) return faired.error();
    keep(level, std::move(*faired));
    return std::nullopt;
  }

  /// Whether the tolerance allows the whole target over the spans of any level.
  bool isAllowed() {
    for (std::size_t i = levels_.first; i < levels_.all.size() && !context_.isCancelled(); ++i)
      if (needOf(i, toleranceMm_)) return true;
    return false;
  }

  /// The better one of this and the best.
  void keep(std::size_t level, FairedCurve faired) {
    const FairingReport& report = faired.report;
    states_[level].neededMm = report.neededMm;
    states_[level].isTried = true;
    const auto isBetter = [&](const FairingReport& than) {
      return report.extremaAfter < than.extremaAfter ||
             (report.extremaAfter == than.extremaAfter && report.withinTolerance && !than.withinTolerance);
    };
    if (!best_ || isBetter(best_->faired.report)) best_ = LevelOutcome{level, {}, std::move(faired)};
  }

  /// What a level needs, where that is no more than `most`.
  std::optional<double> needOf(std::size_t level, double most) {
    std::optional<double>& mm = states_[level].neededMm;
    if (!mm && most > 0.0) mm = neededWithin(targetOf(level), most);
    return mm && *mm <= most ? mm : std::nullopt;
  }

  /// Of the most spans, which every tolerance has, and of those that need less than they do.
  /// @return the level that needs least.
  std::optional<std::size_t> findNeed() {
    const double claimed = setup_->claimedMm(), largest = kLargestToleranceMm - claimed;
    std::optional<std::size_t> least;
    const auto offer = [&](std::size_t i, double most) {
      const auto need = needOf(i, most);
      const double needed = std::max(levels_.all[i].fromMm, need.value_or(0.0) + claimed);
      if (!need || (least && needed >= neededMm_)) return;
      neededMm_ = needed;
      least = i;
    };
    for (std::size_t i = 0; i < levels_.all.size(); ++i)
      if (states_[i].neededMm) offer(i, largest);
    for (std::size_t i = levels_.all.size(); i-- > 0 && !context_.isCancelled();) {
      if (least && levels_.all[i].fromMm >= neededMm_) break;
      offer(i, least ? std::min(neededMm_ - claimed, largest) : largest);
    }
    // What no tolerance allows is said of the most spans.
    if (!least && !context_.isCancelled()) offer(levels_.all.size() - 1, kNoLimit);
    if (least) best_->faired.report.neededMm = neededMm_ - claimed;
    return least;
  }

  /// Where the tolerance meets the target, but the curve does not: it does, if that takes no extremum more.
  void meet(std::size_t level) {
    const bool isAllowed = level >= levels_.first && *states_[level].neededMm <= toleranceMm_;
    if (best_->faired.report.withinTolerance || !isAllowed || context_.isCancelled()) return;
    const std::optional<double> needed = best_->faired.report.neededMm;
    if (!states_[level].isTried) tryLevel(level);
    best_->faired.report.neededMm = needed;
    const std::optional<double> ofBest = states_[best_->level].neededMm;
    const bool isOutOfReach = !ofBest || *ofBest > toleranceMm_;
    if (!best_->faired.report.withinTolerance && isOutOfReach) noteMetOverMoreSpans(best_->faired.report);
  }

  Result<LevelOutcome> finished() {
    if (context_.isCancelled()) return cancelled();
    best_->profile = profileOf(best_->level);
    return std::move(*best_);
  }

  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();  // mm
  const std::shared_ptr<const FairingSetup>& setup_;
  const TargetLevels& levels_;
  int degree_;
  double toleranceMm_;
  const RunContext& context_;
  std::vector<LevelState> states_;  ///< Per level.
  double neededMm_ = 0.0;           ///< The least tolerance.
  std::optional<LevelOutcome> best_;
};

}  // namespace

TargetLevels oneLevel(std::vector<double> splits, TargetSet targets) {
  TargetLevels levels;
  levels.all.push_back({0.0, std::move(splits)});
  levels.targets = std::move(targets);
  return levels;
}

TargetProfile TargetLevels::profile(std::size_t level, int degree) const {
  if (level == first) return targets.profiles[degree - 1];
  TargetParams own = params;
  own.splits = all[level].splits;
  return fitTarget(start, own, closed, degree);
}

TargetLevels targetLevels(const NurbsCurve& curve, bool closed, const FairingParams& params, CancelCheck check) {
  TargetLevels levels;
  levels.params = params.targets;
  levels.closed = closed;
  const auto calm = withoutTremor(curve, closed, params, check);
  levels.start = calm ? *calm : curve;
  levels.all.push_back({0.0, params.targets.splits});
  if (hasNaturalSpans(params.targets)) {
    const std::vector<SpanLevel> spans = naturalSpanLevels(levels.start, closed);
    levels.first = levelOf(spans, params.toleranceMm);
    levels.all.clear();
    for (const SpanLevel& one : spans) levels.all.push_back({one.fromMm, one.splits});
  }
  TargetParams first = params.targets;
  first.splits = levels.ofTolerance().splits;
  levels.targets = fitTargets(levels.start, first, closed);
  if (calm) levels.targets.samples = sampledCurvature(curve, first.samples).places();  // what is shown of the curve
  return levels;
}

Result<LevelOutcome> fairOverLevels(const std::shared_ptr<const FairingSetup>& setup, const TargetLevels& levels,
                                    int degree, double toleranceMm, const RunContext& context, LevelSearch search) {
  return LevelFairing(setup, levels, degree, toleranceMm, context).run(search);
}

}  // namespace batten
