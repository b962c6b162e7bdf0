// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/followed_target.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/fairing/corner_sections.h"
#include "core/fairing/profile/drawn_profile.h"
#include "core/fairing/target/calm_curve.h"
#include "core/fairing/target/natural_spans.h"
#include "core/fairing/target/span_fairing.h"
#include "core/fairing/target_splits.h"

namespace batten {
namespace {

/// Cubic pieces that stand for the polynomials between two corners.
constexpr int kNodesBetweenCorners = 120;

std::optional<TargetProfile> ofDegree(const TargetSet& targets, std::optional<int> degree) {
  if (!degree || *degree < 1 || *degree > std::ssize(targets.profiles)) return std::nullopt;
  const TargetProfile& profile = targets.profiles[*degree - 1];
  return profile.valid ? std::optional(profile) : std::nullopt;
}

/// The targets of single spans; where none is, the curve's own curvature.
std::optional<TargetProfile> ofSpans(const NurbsCurve& start, bool closed, const FairingParams& params) {
  const std::vector<double> splits = targetSplits(start, closed, params);
  std::optional<TargetProfile> all;
  for (const SpanTarget& wanted : params.spanTargets) {
    const ProfileSpan span = spanBetween(splits, wanted.at, closed);
    const TargetSet targets = fitSpanTargets(start, closed, params.targets, span);
    const auto own = ofDegree(targets, wanted.degree);
    if (!own) continue;
    if (!all) {
      all = own;
      continue;
    }
    const auto isIn = [&](const ProfileNode& node) {
      return (node.f >= span.from && node.f <= span.to) || (node.f + 1.0 >= span.from && node.f + 1.0 <= span.to);
    };
    std::erase_if(all->nodes, isIn);
    std::copy_if(own->nodes.begin(), own->nodes.end(), std::back_inserter(all->nodes), isIn);
    std::stable_sort(all->nodes.begin(), all->nodes.end(),
                     [](const ProfileNode& a, const ProfileNode& b) { return a.f < b.f; });
    all->similarity = std::min(all->similarity, own->similarity);
  }
  return all;
}

/// The polynomials of the parts between corners, one after the other. @pre report.targetDegree
std::optional<TargetProfile> ofSections(const std::vector<CornerSection>& sections, bool closed,
                                        const FairingParams& params, const FairingReport& report) {
  TargetProfile all;
  all.degree = *report.targetDegree;
  all.similarity = 1.0;
  for (const CornerSection& section : sections) {
    const double from = section.span.from, width = section.span.to - from;
    const double trifle = 1e-9 * width;
    const NurbsCurve begun = targetStart(section.curve, false, paramsOfSection(params, section, closed));
    TargetParams own = params.targets;
    own.splits.clear();
    for (const double f : report.targetSplits)
      if (f > from + trifle && f < section.span.to - trifle) own.splits.push_back((f - from) / width);
    const auto profile = ofDegree(fitTargets(begun, own), *report.targetDegree);
    if (!profile) return std::nullopt;
    if (!section.isStraight) all.similarity = std::min(all.similarity, profile->similarity);
    for (int i = 0; i <= kNodesBetweenCorners; ++i) {
      const double x = static_cast<double>(i) / kNodesBetweenCorners, step = 0.5 / kNodesBetweenCorners;
      const double low = std::max(0.0, x - step), high = std::min(1.0, x + step);
      const double slope = (profile->curvatureAt(high) - profile->curvatureAt(low)) / ((high - low) * width);
      all.nodes.push_back({from + x * width, profile->curvatureAt(x), slope});
    }
  }
  all.valid = !all.nodes.empty();
  return all.valid ? std::optional(std::move(all)) : std::nullopt;
}

}  // namespace

std::optional<TargetProfile> followedTarget(const NurbsCurve& start, bool closed, const FairingParams& params,
                                            const FairingReport& report) {
  if (params.mode != FairingMode::Target || start.isEmpty()) return std::nullopt;
  if (params.target == FairingTarget::Drawn) {
    TargetProfile drawn = drawnProfile(params.profile, closed);
    return drawn.valid ? std::optional(std::move(drawn)) : std::nullopt;
  }
  if (params.target == FairingTarget::LogAesthetic) {
    auto wanted = logAestheticOf(start, closed, params);
    return wanted.profile.valid ? std::optional(std::move(wanted.profile)) : std::nullopt;
  }
  const std::vector<CornerSection> sections = cornerSections(start, closed);
  if (!params.spanTargets.empty()) return sections.empty() ? ofSpans(start, closed, params) : std::nullopt;
  if (report.targetDegree && !sections.empty()) return ofSections(sections, closed, params, report);
  TargetParams own = params.targets;
  if (report.targetDegree) own.splits = report.targetSplits;
  const TargetSet targets = fitTargets(targetStart(start, closed, params), own, closed);
  // Edge lengths follow one polynomial over the whole path.
  if (report.targetDegree) return ofDegree(targets, report.targetDegree);
  const std::optional<int> asked = degreeOf(params.target);
  return ofDegree(targets, asked ? asked : targets.recommendedDegree);
}

}  // namespace batten
