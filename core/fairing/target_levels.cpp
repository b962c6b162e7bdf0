// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target_levels.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "core/fairing/corner_sections.h"
#include "core/fairing/fairing.h"
#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/profile/target_degrees.h"
#include "core/fairing/target/calm_curve.h"
#include "core/fairing/target/natural_spans.h"
#include "core/fairing/target/shape_modification.h"
#include "core/fairing/target/span_fairing.h"

namespace batten {
namespace {

bool hasNaturalSpans(const TargetParams& params) {
  return params.splits.empty() && params.spans == TargetSpans::Natural && params.quantity == TargetQuantity::Curvature;
}

struct LevelNeed {
  std::optional<double> mm;  ///< The tolerance that meets the target.
  bool isTried = false;      ///< And the curve for the tolerance is known.
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
        needs_(levels.all.size()),
        targets_(levels.all.size()),
        profiles_(levels.all.size()) {}

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
    auto& profile = profiles_[level];
    if (!profile) profile = levels_.profile(level, degree_);
    return *profile;
  }
  TargetCourses& targetOf(std::size_t level) {
    auto& target = targets_[level];
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
    needs_[level] = {report.neededMm, true};
    const auto isBetter = [&](const FairingReport& than) {
      return report.extremaAfter < than.extremaAfter ||
             (report.extremaAfter == than.extremaAfter && report.withinTolerance && !than.withinTolerance);
    };
    if (!best_ || isBetter(best_->faired.report)) best_ = LevelOutcome{level, {}, std::move(faired)};
  }

  /// What a level needs, where that is no more than `most`.
  std::optional<double> needOf(std::size_t level, double most) {
    std::optional<double>& mm = needs_[level].mm;
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
      if (needs_[i].mm) offer(i, largest);
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
    const bool isAllowed = level >= levels_.first && *needs_[level].mm <= toleranceMm_;
    if (best_->faired.report.withinTolerance || !isAllowed || context_.isCancelled()) return;
    const std::optional<double> needed = best_->faired.report.neededMm;
    if (!needs_[level].isTried) tryLevel(level);
    best_->faired.report.neededMm = needed;
    const std::optional<double> ofBest = needs_[best_->level].mm;
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
  std::vector<LevelNeed> needs_;                         ///< Per level.
  std::vector<std::unique_ptr<TargetCourses>> targets_;  ///< Of the levels that were looked at.
  std::vector<std::optional<TargetProfile>> profiles_;   ///< Of the same.
  double neededMm_ = 0.0;                                ///< The least tolerance.
  std::optional<LevelOutcome> best_;
};

}  // namespace

std::vector<double> targetSplits(const NurbsCurve& curve, bool closed, const FairingParams& params, CancelCheck check) {
  const bool isNatural = hasNaturalSpans(params.targets);
  const auto naturalOf = [&check](const NurbsCurve& one, bool isClosed, const FairingParams& own) {
    return naturalSplits(targetStart(one, isClosed, own, check), isClosed, own.toleranceMm);
  };
  const auto sections = cornerSections(curve, closed);
  if (sections.empty()) return isNatural ? naturalOf(curve, closed, params) : params.targets.splits;
  std::vector<double> splits = isNatural ? std::vector<double>{} : params.targets.splits;
  for (const CornerSection& section : sections) {
    if (section.span.from > 0.0 || closed) splits.push_back(section.span.from);
    if (!isNatural || section.isStraight) continue;
    for (const double f : naturalOf(section.curve, false, paramsOfSection(params, section, closed)))
      splits.push_back(section.span.from + f * (section.span.to - section.span.from));
  }
  std::sort(splits.begin(), splits.end());
  return splits;
}

LogAestheticTarget logAestheticOf(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                  CancelCheck check) {
  return logAestheticTarget(targetStart(curve, closed, params, check), closed,
                            targetSplits(curve, closed, params, check), params.alpha, params.targets.samples);
}

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

namespace {

std::optional<int> mostSimilar(const FairedByDegree& faired) {
  std::optional<int> degree;
  double best = 0.0;
  for (std::size_t i = 0; i < faired.size(); ++i) {
    if (!faired[i] || !faired[i]->report.similarityAfter) continue;
    const double s = *faired[i]->report.similarityAfter;
    if (degree && s <= best) continue;
    degree = static_cast<int>(i) + 1;
    best = s;
  }
  return degree;
}

std::optional<int> fairest(const FairedByDegree& faired, std::optional<int> nearest, double toleranceMm) {
  std::optional<int> best;
  const auto rank = [&](int degree) {
    const FairingReport& report = faired[degree - 1]->report;
    const bool isMet = report.withinTolerance && report.extremaAfter <= report.extremaBefore;
    const bool isAllowed = degree == nearest || (report.neededMm && *report.neededMm <= toleranceMm);
    return std::tuple(!isMet, !isAllowed, report.extremaAfter);
  };
  for (int degree = 1; degree <= kMostTargetDegree; ++degree)
    if (faired[degree - 1] && (!best || rank(degree) < rank(*best))) best = degree;
  return best;
}

}  // namespace

std::optional<int> degreeToRecommend(const FairedByDegree& faired, std::optional<int> nearest,
                                     const FairingParams& params) {
  return params.targetChoice == TargetChoice::Similarity ? mostSimilar(faired)
                                                         : fairest(faired, nearest, params.toleranceMm);
}

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
