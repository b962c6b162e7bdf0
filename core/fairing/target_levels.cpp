// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target_levels.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/fairing/corner_sections.h"
#include "core/fairing/fairing.h"
#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/target/calm_curve.h"
#include "core/fairing/target/natural_spans.h"
#include "core/fairing/target/shape_modification.h"
#include "core/fairing/target/span_fairing.h"

namespace batten {
namespace {

bool hasNaturalSpans(const TargetParams& params) {
  return params.splits.empty() && params.spans == TargetSpans::Natural && params.quantity == TargetQuantity::Curvature;
}

std::vector<double> naturalSplitsOf(const NurbsCurve& curve, bool closed, const FairingParams& params) {
  return naturalSplits(withoutTremor(curve, closed, params), closed);
}

/// The levels that are followed for one degree, and what comes of them.
class LevelSearch {
 public:
  LevelSearch(const FairingSetup& setup, std::span<const TargetLevel> levels)
      : levels_(levels), mostMm_(kSensibleShare * setup.extent) {}

  bool isEmpty() const { return tried_.empty(); }
  bool meetsAny() const {
    return std::any_of(tried_.begin(), tried_.end(), [](const Tried& one) { return one.isMet(); });
  }
  /// Whether this level is to be followed, after those before it.
  bool needs(std::size_t level) const {
    if (tried_.empty()) return true;
    if (!levels_[level].isFiner) return !isSound_;
    const auto tooMany = [this](const Tried& one) { return one.faired.report.extremaAfter > fewest_; };
    return std::all_of(tried_.begin(), tried_.end(), tooMany);
  }
  void add(std::size_t level, FairedCurve faired) {
    const FairingReport& report = faired.report;
    if (!levels_[level].isFiner && !isSound_) {
      isSound_ = report.extremaOnTheWay <= std::ssize(levels_[level].splits) && report.neededMm <= mostMm_;
      if (isSound_) fewest_ = static_cast<int>(levels_[level].splits.size());
      if (tried_.empty() || isSound_ || order(report) < order(tried_[aim_].faired.report)) aim_ = tried_.size();
    }
    tried_.push_back({level, std::move(faired)});
  }
  LevelOutcome best(double toleranceMm) {
    const double neededMm = tried_[aim_].faired.report.neededMm;
    std::size_t best = isSound_ ? aim_ : 0;
    for (std::size_t i = 0; i < tried_.size(); ++i)
      if (isBetter(tried_[i], tried_[best])) best = i;
    LevelOutcome outcome{tried_[best].level, std::move(tried_[best].faired), static_cast<int>(tried_.size())};
    FairingReport& report = outcome.faired.report;
    if (report.withinTolerance && neededMm > toleranceMm) {
      // The spans of the target need more than those that were followed.
      report.withinTolerance = false;
      report.why = Termination::ToleranceLimited;
      report.note = kFollowedWithinTolerance;
    }
    report.neededMm = neededMm;
    return outcome;
  }

 private:
  struct Tried {
    std::size_t level;
    FairedCurve faired;
    bool isMet() const { return faired.report.withinTolerance; }
  };

  static std::pair<int, double> order(const FairingReport& report) { return {report.extremaOnTheWay, report.neededMm}; }
  int rank(const Tried& one) const { return std::max(one.faired.report.extremaAfter, fewest_); }
  bool isBetter(const Tried& a, const Tried& b) const {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    if (a.isMet() != b.isMet()) return a.isMet();
    return a.isMet() && a.faired.report.maxDeviationMm < b.faired.report.maxDeviationMm;
  }
  std::span<const TargetLevel> levels_;
  double mostMm_;
  std::vector<Tried> tried_;
  std::size_t aim_ = 0;   ///< Of those tried, the one whose target counts as the target of this degree.
  bool isSound_ = false;  ///< That one leaves no more extrema than it has splits, and keeps the shape.
  int fewest_ = 0;        ///< Extrema that are none too many.
};

}  // namespace

std::vector<double> targetSplits(const NurbsCurve& curve, bool closed, const FairingParams& params) {
  const bool isNatural = hasNaturalSpans(params.targets);
  const auto sections = cornerSections(curve, closed);
  if (sections.empty()) return isNatural ? naturalSplitsOf(curve, closed, params) : params.targets.splits;
  std::vector<double> splits = isNatural ? std::vector<double>{} : params.targets.splits;
  for (const CornerSection& section : sections) {
    if (section.span.from > 0.0 || closed) splits.push_back(section.span.from);
    if (!isNatural || section.isStraight) continue;
    for (const double f : naturalSplitsOf(section.curve, false, params))
      splits.push_back(section.span.from + f * (section.span.to - section.span.from));
  }
  std::sort(splits.begin(), splits.end());
  return splits;
}

std::vector<TargetLevel> targetLevels(const NurbsCurve& curve, bool closed, const FairingParams& params) {
  const bool isNatural = hasNaturalSpans(params.targets);
  const NurbsCurve calm = withoutTremor(curve, closed, params);
  std::vector<SplitLevel> splits = {{params.targets.splits, false}};
  if (isNatural) splits = naturalSplitLevels(calm, closed);
  std::vector<TargetLevel> levels;
  for (SplitLevel& one : splits) {
    TargetParams targets = params.targets;
    targets.splits = one.splits;
    levels.push_back({std::move(one.splits), fitTargets(calm, targets, closed), one.isFiner});
    if (calm == curve) continue;
    const CurvatureSamples samples = sampledCurvature(curve, targets.samples);
    levels.back().targets.perimeter = samples.perimeter;
    levels.back().targets.kappa = samples.kappa;
  }
  return levels;
}

Result<LevelOutcome> fairOverLevels(const std::shared_ptr<const FairingSetup>& setup,
                                    std::span<const TargetLevel> levels, int degree, double toleranceMm,
                                    const RunContext& context, bool onlyIfMet) {
  LevelSearch search(*setup, levels);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (!search.needs(i)) continue;
    if (levels[i].isFiner && onlyIfMet && !search.meetsAny()) break;
    const TargetProfile& profile = levels[i].targets.profiles[static_cast<std::size_t>(degree) - 1];
    auto faired = modifyShape(setup, profile, toleranceMm, context, {ExtremaAsked::UpToSketch, onlyIfMet});
    if (!faired && (search.isEmpty() || faired.error().code == ErrorCode::Cancelled)) return fail(faired.error());
    if (faired) search.add(i, std::move(*faired));
  }
  return search.best(toleranceMm);
}

Result<FairedCurve> fairToTarget(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                 const RunContext& context) {
  if (!params.spanTargets.empty())
    return fairSpans(curve, closed, targetSplits(curve, closed, params), params, context);
  const std::vector<TargetLevel> levels = targetLevels(curve, closed, params);
  const TargetSet& first = levels.front().targets;
  if (first.recommendedDegree == 0)
    return unchanged(curve, closed, Termination::Degenerate, first.profiles.front().problem);
  if (const auto asked = degreeOf(params.target)) {
    const TargetProfile& profile = first.profiles[static_cast<std::size_t>(*asked) - 1];
    if (!profile.valid) return unchanged(curve, closed, Termination::Degenerate, profile.problem);
  }
  return withSetup(
      curve, closed, params, context, [&](const auto& setup, const FairingParams& within) -> Result<FairedCurve> {
        const auto followed = [&](LevelOutcome&& outcome, int degree) {
          outcome.faired.report.targetDegree = degree;
          outcome.faired.report.targetSplits = levels[outcome.level].splits;
          return std::move(outcome.faired);
        };
        const auto toDegree = [&](int degree, bool onlyIfMet = false) -> Result<LevelOutcome> {
          return fairOverLevels(setup, levels, degree, within.toleranceMm, context, onlyIfMet);
        };
        int degree = degreeOf(params.target).value_or(0);
        if (degree == 0 && params.targetChoice == TargetChoice::Similarity) {
          FairedByDegree all;
          for (int tried = 1; tried <= 6; ++tried) {
            const auto at = static_cast<std::size_t>(tried) - 1;
            if (!first.profiles[at].valid) continue;
            auto outcome = toDegree(tried);
            if (!outcome) return fail(outcome.error());
            all[at] = followed(std::move(*outcome), tried);
          }
          if (const auto best = mostSimilar(all)) return std::move(*all[static_cast<std::size_t>(*best) - 1]);
          const auto any = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.has_value(); });
          if (any != all.end()) return std::move(**any);
        }
        for (int tried = 1; tried <= 6 && degree == 0; ++tried) {
          if (!first.profiles[static_cast<std::size_t>(tried) - 1].valid) continue;
          auto outcome = toDegree(tried, true);
          // With less effort another level may have come out best.
          if (outcome && outcome->isMet() && outcome->tried > 1) outcome = toDegree(tried, false);
          if (!outcome) return fail(outcome.error());
          if (outcome->isMet()) return followed(std::move(*outcome), tried);
        }
        if (degree == 0) degree = first.recommendedDegree;
        auto outcome = toDegree(degree);
        if (!outcome) return fail(outcome.error());
        return followed(std::move(*outcome), degree);
      });
}

}  // namespace batten
