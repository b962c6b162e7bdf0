// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target_levels.h"

#include <algorithm>
#include <utility>

#include "core/fairing/corner_sections.h"
#include "core/fairing/fairing.h"
#include "core/fairing/target/natural_spans.h"
#include "core/fairing/target/shape_modification.h"
#include "core/fairing/target/span_fairing.h"

namespace batten {
namespace {

/// A profile of more polynomials says nothing that the curve does not say itself.
constexpr std::size_t kMostSplits = 24;

bool hasNaturalSpans(const TargetParams& params) {
  return params.splits.empty() && params.spans == TargetSpans::Natural && params.quantity == TargetQuantity::Curvature;
}

}  // namespace

std::vector<double> targetSplits(const NurbsCurve& curve, bool closed, const FairingParams& params) {
  const bool isNatural = hasNaturalSpans(params.targets);
  const auto sections = cornerSections(curve, closed);
  if (sections.empty()) return isNatural ? naturalSplits(curve, closed, params.toleranceMm) : params.targets.splits;
  std::vector<double> splits = isNatural ? std::vector<double>{} : params.targets.splits;
  for (const CornerSection& section : sections) {
    if (section.span.from > 0.0 || closed) splits.push_back(section.span.from);
    if (!isNatural || section.isStraight) continue;
    for (const double f : naturalSplits(section.curve, false, params.toleranceMm))
      splits.push_back(section.span.from + f * (section.span.to - section.span.from));
  }
  std::sort(splits.begin(), splits.end());
  return splits;
}

std::vector<TargetLevel> targetLevels(const NurbsCurve& curve, bool closed, const FairingParams& params) {
  std::vector<std::vector<double>> splits = {params.targets.splits};
  if (hasNaturalSpans(params.targets)) splits = naturalSplitLevels(curve, closed, params.toleranceMm);
  std::vector<TargetLevel> levels;
  for (auto& one : splits) {
    if (!levels.empty() && one.size() > kMostSplits) break;
    TargetParams targets = params.targets;
    targets.splits = one;
    levels.push_back({std::move(one), fitTargets(curve, targets, closed)});
  }
  return levels;
}

Result<LevelOutcome> fairOverLevels(const std::shared_ptr<const FairingSetup>& setup,
                                    std::span<const TargetLevel> levels, int degree, double toleranceMm,
                                    const RunContext& context, bool onlyIfMet) {
  std::optional<LevelOutcome> best;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    // No fewer than the extrema between the spans are looked for.
    const auto fewest = static_cast<int>(levels.front().splits.size());
    if (best && best->faired.report.extremaAfter <= fewest) break;
    const TargetProfile& profile = levels[i].targets.profiles[degree - 1];
    auto faired = modifyShape(setup, profile, toleranceMm, context, {ExtremaAsked::UpToSketch, onlyIfMet});
    if (!faired && best) break;
    if (!faired) return fail(faired.error());
    if (!best || faired->report.extremaAfter < best->faired.report.extremaAfter)
      best = LevelOutcome{i, std::move(*faired)};
  }
  return std::move(*best);
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
    const TargetProfile& profile = first.profiles[*asked - 1];
    if (!profile.valid) return unchanged(curve, closed, Termination::Degenerate, profile.problem);
  }
  return withSetup(
      curve, closed, params, context, [&](const auto& setup, const FairingParams& within) -> Result<FairedCurve> {
        const auto followed = [&](LevelOutcome&& outcome, int degree) {
          outcome.faired.report.targetDegree = degree;
          outcome.faired.report.targetSplits = levels[outcome.level].splits;
          return std::move(outcome.faired);
        };
        const auto toDegree = [&](int degree, std::span<const TargetLevel> over,
                                  bool onlyIfMet = false) -> Result<LevelOutcome> {
          return fairOverLevels(setup, over, degree, within.toleranceMm, context, onlyIfMet);
        };
        int degree = degreeOf(params.target).value_or(0);
        if (degree == 0 && params.targetChoice == TargetChoice::Similarity) {
          FairedByDegree all;
          for (int tried = 1; tried <= 6; ++tried) {
            const auto at = static_cast<std::size_t>(tried) - 1;
            if (!first.profiles[at].valid) continue;
            auto outcome = toDegree(tried, levels);
            if (!outcome) return fail(outcome.error());
            all[at] = followed(std::move(*outcome), tried);
          }
          if (const auto best = mostSimilar(all)) return std::move(*all[*best - 1]);
          const auto any = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.has_value(); });
          if (any != all.end()) return std::move(**any);
        }
        for (int tried = 1; tried <= 6 && degree == 0; ++tried) {
          if (!first.profiles[tried - 1].valid) continue;
          auto outcome = toDegree(tried, std::span(levels).first(1), true);
          if (!outcome) return fail(outcome.error());
          if (outcome->isMet()) return followed(std::move(*outcome), tried);
        }
        if (degree == 0) degree = first.recommendedDegree;
        auto outcome = toDegree(degree, levels);
        if (!outcome) return fail(outcome.error());
        return followed(std::move(*outcome), degree);
      });
}

}  // namespace batten
