// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/corner_sections.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "core/base/parallel.h"
#include "core/curve/arc_length.h"
#include "core/curve/corners_inside.h"
#include "core/curve/knot_operations.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/profile/target_degrees.h"
#include "core/fairing/recommended_degree.h"

namespace batten {
namespace {

constexpr double kStraight = 1e-9;    // of the extent
constexpr double kJoins = 1e-6;       // of the extent
constexpr double kTrifle = 1e-4;      // of a part
constexpr int kNodesPerSection = 48;  // of a profile that is copied to a section
constexpr const char* kAddsAtCorners = "Unchanged: fairing its parts would add curvature extrema.";  // a note

bool isStraightLine(const NurbsCurve& curve) {
  const Vec2 first = curve.controlPoints().front(), chord = curve.controlPoints().back() - first;
  const double length = chord.norm(), most = kStraight * extent(curve);
  return std::all_of(curve.controlPoints().begin(), curve.controlPoints().end(),
                     [&](const Vec2& p) { return length > 0.0 && std::abs(cross(chord, p - first)) <= most * length; });
}

double widthOf(const ProfileSpan& span) { return span.to - span.from; }
double within(const ProfileSpan& span, double f) { return (f - span.from) / widthOf(span); }
double across(const ProfileSpan& span, double f) { return span.from + f * widthOf(span); }

/// What the parameters ask of one part.
FairingParams paramsOf(const FairingParams& whole, const ProfileSpan& span, bool closed) {
  FairingParams params = whole;
  const double trifle = kTrifle * widthOf(span);  // what rounding makes of a place at the corner
  const auto isIn = [&](double f) { return f > span.from + trifle && f < span.to - trifle; };
  params.keptAt.clear();
  for (const double f : whole.keptAt)
    if (isIn(f)) params.keptAt.push_back(within(span, f));
  // The extrema that are named count alone: where none is, none stays.
  if (!whole.keptAt.empty() && params.keptAt.empty()) params.keepExtrema = {0};
  params.targets.splits.clear();
  for (const double f : whole.targets.splits)
    if (isIn(f)) params.targets.splits.push_back(within(span, f));
  if (!whole.targets.splits.empty() && params.targets.splits.empty()) params.targets.spans = TargetSpans::Whole;
  params.spanTargets.clear();
  for (const SpanTarget& one : whole.spanTargets)
    if (one.at >= span.from && one.at <= span.to) params.spanTargets.push_back({within(span, one.at), one.degree});
  if (span.from > 0.0) params.startHold = {};
  if (span.to < 1.0) params.endHold = {};
  if (closed) params.startHold = params.endHold = {};
  if (whole.target == FairingTarget::Drawn && !whole.profile.empty()) {
    const TargetProfile drawn = drawnProfile(whole.profile, closed);
    params.profile = {{0.0, drawn.valid ? drawn.curvatureAt(span.from) : 0.0}};
    for (const ProfilePoint& point : whole.profile)
      if (isIn(point.fraction)) params.profile.push_back({within(span, point.fraction), point.kappa});
    params.profile.push_back({1.0, drawn.valid ? drawn.curvatureAt(span.to) : 0.0});
  }
  return params;
}

/// The degree that all parts but the straight ones followed; absent: there is none.
std::optional<int> commonDegree(const std::vector<CornerSection>& sections, const std::vector<FairedCurve>& parts) {
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (sections[i].isStraight) continue;
    if (!first) first = i;
    if (parts[i].report.targetDegree != parts[*first].report.targetDegree) return std::nullopt;
  }
  return first ? parts[*first].report.targetDegree : std::nullopt;
}

/// The parts as one curve again, with what they report.
Result<FairedCurve> joinedParts(const NurbsCurve& whole, bool closed, const std::vector<CornerSection>& sections,
                                std::vector<FairedCurve> parts, CancelCheck check) {
  FairedCurve result;
  std::vector<ProfileSpan> spans;
  spans.reserve(sections.size());
  for (const CornerSection& section : sections) spans.push_back(section.span);
  std::vector<NurbsCurve> curves;
  for (FairedCurve& part : parts) {
    addPart(result.report, part.report);
    const CornerSection& section = sections[curves.size()];
    if (section.span.from > 0.0) result.report.targetSplits.push_back(section.span.from);
    for (const double f : part.report.targetSplits) result.report.targetSplits.push_back(across(section.span, f));
    for (LogAestheticSpan span : part.report.logAesthetic) {
      span.from = across(spans[curves.size()], span.from);
      span.to = across(spans[curves.size()], span.to);
      result.report.logAesthetic.push_back(span);
    }
    curves.push_back(std::move(part.curve));
  }
  auto joined = joinAtCorners(curves, kJoins * extent(whole));
  if (!joined) return fail(joined.error());
  result.curve = std::move(*joined);
  result.report.targetDegree = commonDegree(sections, parts);
  result.report.extremaBefore = countedExtrema(whole, closed, check);
  result.report.extremaAfter = countedExtrema(result.curve, closed, check);
  if (result.report.extremaAfter <= result.report.extremaBefore) return result;
  auto same = unchanged(whole, closed, Termination::ToleranceLimited, kAddsAtCorners, check);
  same.report.neededMm = result.report.neededMm;
  same.report.withinTolerance = false;
  return same;
}

Result<FairedCurve> fairSections(const NurbsCurve& curve, bool closed, const std::vector<CornerSection>& sections,
                                 const FairingParams& params, const RunContext& context, const FairingLine& line) {
  if (const auto error = validate(params)) return fail(*error);
  std::vector<Result<FairedCurve>> made(sections.size(), cancelled());
  parallelFor(context, static_cast<int>(sections.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const CornerSection& section = sections[i];
      const FairingParams own = paramsOf(params, section.span, closed);
      const bool isLeft = section.isStraight || (!params.spanTargets.empty() && own.spanTargets.empty());
      made[i] = isLeft ? Result<FairedCurve>(unchanged(section.curve, false, Termination::Converged, {}, context))
                       : fair(section.curve, false, own, context, line);
    }
  });
  if (context.isCancelled()) return cancelled();
  std::vector<FairedCurve> parts;
  for (auto& one : made) {
    if (!one) return one;
    parts.push_back(std::move(*one));
  }
  auto joined = joinedParts(curve, closed, sections, std::move(parts), context);
  if (context.isCancelled()) return cancelled();
  return joined;
}

/// A straight part, or one that another span's target leaves alone.
TargetOutcomes asItIs(const CornerSection& section, const TargetParams& params) {
  TargetOutcomes outcomes;
  const CurvatureSamples samples = sampledCurvature(section.curve, params.samples);
  outcomes.targets.samples = samples.places();
  const int count = samples.count();
  for (std::size_t d = 0; d < outcomes.faired.size(); ++d) {
    TargetProfile& profile = outcomes.targets.profiles[d];
    profile.degree = static_cast<int>(d) + 1;
    profile.valid = profile.isMonotone = true;
    profile.similarity = profile.pearson = 1.0;
    for (int i = 0; i < count; ++i) {
      const int a = i > 0 ? i - 1 : 0, b = std::min(i + 1, count - 1);
      const double slope = (samples.kappa[b] - samples.kappa[a]) / (samples.perimeter(b) - samples.perimeter(a));
      profile.nodes.push_back({samples.perimeter(i), samples.kappa[i], slope});
    }
    outcomes.faired[d] = unchanged(section.curve, false, Termination::Converged, {});
  }
  return outcomes;
}

std::vector<ProfileNode> nodesOf(const TargetProfile& profile) {
  if (!profile.nodes.empty()) return profile.nodes;
  std::vector<ProfileNode> nodes;
  constexpr double kStep = 1e-4;  // of the length: for a slope by differences
  for (int i = 0; i <= kNodesPerSection; ++i) {
    const double f = static_cast<double>(i) / kNodesPerSection;
    const double slope = (profile.curvatureAt(f + kStep) - profile.curvatureAt(f - kStep)) / (2.0 * kStep);
    nodes.push_back({f, profile.curvatureAt(f), slope});
  }
  return nodes;
}

/// The target of one degree over all parts.
void addProfile(TargetProfile& whole, const TargetProfile& part, const ProfileSpan& span, bool isFirst) {
  whole.degree = part.degree;
  whole.valid = part.valid && (isFirst || whole.valid);
  if (!part.valid && whole.problem.empty()) whole.problem = part.problem;
  if (!whole.valid) return;
  for (const ProfileNode& node : nodesOf(part))
    whole.nodes.push_back({across(span, node.f), node.value, node.slope / widthOf(span)});
  whole.isMonotone = part.isMonotone && (isFirst || whole.isMonotone);
  whole.similarity = isFirst ? part.similarity : std::min(whole.similarity, part.similarity);
  whole.pearson = isFirst ? part.pearson : std::min(whole.pearson, part.pearson);
  whole.rmsPercent = std::max(whole.rmsPercent, part.rmsPercent);
  if (isFirst)
    whole.aicc = part.aicc;
  else if (whole.aicc)
    whole.aicc = part.aicc ? std::optional(*whole.aicc + *part.aicc) : std::nullopt;
}

Result<TargetOutcomes> joinedOutcomes(const TargetsJob& job, const std::vector<CornerSection>& sections,
                                      std::vector<Result<TargetOutcomes>>& parts, CancelCheck check) {
  TargetOutcomes whole;
  PerTarget<std::vector<FairedCurve>> faired;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (!parts[i]) return std::move(parts[i]);
    TargetOutcomes& part = *parts[i];
    const ProfileSpan& span = sections[i].span;
    for (const auto& [f, kappa] : part.targets.samples) whole.targets.samples.push_back({across(span, f), kappa});
    whole.targets.comparesCurvature = whole.targets.comparesCurvature || part.targets.comparesCurvature;
    whole.targets.recommendedDegree = std::max(whole.targets.recommendedDegree, part.targets.recommendedDegree);
    if (i > 0 || job.closed) whole.splits.push_back(span.from);
    for (const double f : part.splits) whole.splits.push_back(across(span, f));
    if (part.span) whole.span = ProfileSpan{across(span, part.span->from), across(span, part.span->to)};
    for (std::size_t d = 0; d < faired.size(); ++d) {
      addProfile(whole.targets.profiles[d], part.targets.profiles[d], span, i == 0);
      addSentence(whole.problems[d], part.problems[d]);
      if (!part.faired[d]) continue;
      faired[d].push_back(std::move(*part.faired[d]));
    }
  }
  for (std::size_t d = faired.size(); d-- > 0;) {
    if (faired[d].size() != sections.size()) continue;
    auto joined = joinedParts(job.curve, job.closed, sections, std::move(faired[d]), check);
    if (!joined) {
      whole.problems[d] = joined.error().message;
      continue;
    }
    whole.faired[d] = std::move(*joined);
  }
  const auto best = degreeToRecommend(whole.faired, whole.targets.recommendedDegree, job.params);
  whole.recommendedDegree = best ? best : whole.targets.recommendedDegree;
  return whole;
}

/// A job, or the jobs of its parts.
struct SplitJob {
  std::vector<CornerSection> sections;
  /// Per section (without sections: one); absent where it stays as it is.
  std::vector<std::optional<std::size_t>> jobs;
};

SplitJob splitJob(const TargetsJob& job, std::vector<TargetsJob>& all) {
  SplitJob result{cornerSections(job.curve, job.closed), {}};
  if (result.sections.empty()) {
    result.jobs.push_back(all.size());
    all.push_back(job);
    return result;
  }
  for (const CornerSection& section : result.sections) {
    const bool isPointedAt =
        !job.spanAt || (*job.spanAt >= section.span.from && (*job.spanAt < section.span.to || section.span.to >= 1.0));
    if (section.isStraight || !isPointedAt) {
      result.jobs.push_back(std::nullopt);
      continue;
    }
    TargetsJob own{section.curve, false, paramsOf(job.params, section.span, job.closed), std::nullopt};
    if (job.spanAt) own.spanAt = within(section.span, *job.spanAt);
    result.jobs.push_back(all.size());
    all.push_back(std::move(own));
  }
  return result;
}

}  // namespace

FairingParams paramsOfSection(const FairingParams& whole, const CornerSection& section, bool closed) {
  return paramsOf(whole, section.span, closed);
}

std::vector<CornerSection> cornerSections(const NurbsCurve& curve, bool closed) {
  std::vector<CornerSection> sections;
  if (curve.isEmpty() || curve.isRational() || (closed && !beginsAtCorner(curve))) return sections;
  const std::vector<double> corners = cornersInside(curve);
  if (corners.empty()) return sections;
  const ArcLength arc(curve);
  if (!(arc.total() > 0.0)) return sections;
  auto parts = splitAtAll(curve, corners);
  if (!parts) return sections;
  double from = 0.0;
  for (std::size_t i = 0; i < parts->size(); ++i) {
    const double to = i < corners.size() ? arc.at(corners[i]) / arc.total() : 1.0;
    sections.push_back({std::move((*parts)[i]), {from, to}});
    from = to;
  }
  for (CornerSection& section : sections) section.isStraight = isStraightLine(section.curve);
  return sections;
}

Result<FairedCurve> fairBetweenCorners(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                       const RunContext& context, const FairingLine& line) {
  try {
    const auto sections = cornerSections(curve, closed);
    if (sections.empty() || params.mode == FairingMode::None) return fair(curve, closed, params, context, line);
    return fairSections(curve, closed, sections, params, context, line);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to fair the curve.");
  }
}

std::vector<Result<TargetOutcomes>> targetsBetweenCorners(std::span<const TargetsJob> jobs, const RunContext& context) {
  std::vector<TargetsJob> all;
  std::vector<SplitJob> split;
  for (const TargetsJob& job : jobs) split.push_back(splitJob(job, all));
  auto outcomes = fairAllTargets(all, context);
  std::vector<Result<TargetOutcomes>> results;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const SplitJob& one = split[i];
    if (one.sections.empty()) {
      results.push_back(std::move(outcomes[*one.jobs.front()]));
      continue;
    }
    std::vector<Result<TargetOutcomes>> parts;
    for (std::size_t k = 0; k < one.sections.size(); ++k) {
      parts.push_back(one.jobs[k] ? std::move(outcomes[*one.jobs[k]])
                                  : Result<TargetOutcomes>(asItIs(one.sections[k], jobs[i].params.targets)));
    }
    results.push_back(joinedOutcomes(jobs[i], one.sections, parts, context));
  }
  return results;
}

}  // namespace batten
