// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_chain.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/construct/light/light_search.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

constexpr int kQuinticChain = 5;              // degree of the sections
constexpr int kJoinedOn = 3;                  // multiplicity of knots where a tight turn was joined on
constexpr double kFewestSamplesOfCut = 12.0;  // of the reference, between two cuts
constexpr int kChainRounds = 4;               // of making sections dense again where they brought extrema
constexpr int kWorthCutting = 12;             // control points of a section
constexpr double kSameTangent = 1e-6;         // sine of the angle at a joint
constexpr double kMostStretch = 4.0;          // of one domain at a joint

/// Inner knots of high multiplicity.
std::vector<double> joinedKnots(const NurbsCurve& curve) {
  std::vector<double> found;
  const auto knots = curve.knots();
  for (std::size_t i = 0; i < knots.size();) {
    std::size_t j = i;
    while (j < knots.size() && knots[j] == knots[i]) ++j;
    if (static_cast<int>(j - i) >= kJoinedOn && knots[i] > curve.start() && knots[i] < curve.end()) {
      found.push_back(knots[i]);
    }
    i = j;
  }
  return found;
}

/// Parameter of the sample between two arc lengths where the curvature changes fastest.
double steepest(const LightReference& reference, double from, double to) {
  const std::vector<LightSample>& samples = reference.samples();
  const LightSample* best = nullptr;
  const auto isBefore = [](double s, const LightSample& sample) { return s < sample.s; };
  for (auto it = std::upper_bound(samples.begin(), samples.end(), from, isBefore); it != samples.end(); ++it) {
    if (!(it->s < to)) break;
    if (best == nullptr || std::abs(it->slope) > std::abs(best->slope)) best = &*it;
  }
  return best == nullptr ? reference.at(reference.indexAt(0.5 * (from + to))).u : best->u;
}

/// Arc lengths of the samples nearest to parameters, of equally near ones the first.
std::vector<double> arcLengthsAt(const LightReference& reference, const std::vector<double>& parameters) {
  std::vector<double> found;
  if (parameters.empty()) return found;
  const std::vector<LightSample>& samples = reference.samples();
  std::vector<int> byParameter(samples.size());
  std::iota(byParameter.begin(), byParameter.end(), 0);
  std::stable_sort(byParameter.begin(), byParameter.end(), [&](int a, int b) { return samples[a].u < samples[b].u; });
  for (const double u : parameters) {
    const auto above = std::lower_bound(byParameter.begin(), byParameter.end(), u,
                                        [&](int i, double value) { return samples[i].u < value; });
    std::optional<int> best;
    const auto offer = [&](int i) {
      const double off = std::abs(samples[i].u - u), least = best ? std::abs(samples[*best].u - u) : off;
      if (!best || off < least || (off == least && i < *best)) best = i;
    };
    if (above != byParameter.end()) offer(*above);
    if (above != byParameter.begin()) offer(*std::prev(above));
    found.push_back(samples[*best].s);
  }
  return found;
}

/// Without cuts that leave next to nothing between them, or between them and an end.
std::vector<double> spread(std::vector<double> cuts, const NurbsCurve& curve, double least) {
  std::sort(cuts.begin(), cuts.end());
  std::vector<double> kept;
  for (const double u : cuts) {
    if (u - (kept.empty() ? curve.start() : kept.back()) >= least && curve.end() - u >= least) kept.push_back(u);
  }
  return kept;
}

/// Knots at which stretches between cuts are to be divided that have more than kMostSectionSpans spans. @pre `cuts`
/// ascend.
std::vector<double> cutsOfLongStretches(const std::vector<double>& cuts, const NurbsCurve& curve) {
  std::vector<double> added;
  const std::vector<double> breaks = curve.breaks();
  auto next = cuts.begin();
  int since = 0;
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    ++since;
    for (; next != cuts.end() && *next <= breaks[i]; ++next) since = 0;
    if (since < kMostSectionSpans) continue;
    added.push_back(breaks[i]);
    since = 0;
  }
  return added;
}

struct Section {
  NurbsCurve dense;
  LightHold start = LightHold::Curvature, end = LightHold::Curvature;
};

/// A section as it was and as it is now.
struct MadeSection {
  LightCurve dense, now;

  bool isDense() const { return now.report.kind == LightKind::Dense; }
  double start() const { return dense.curve.start(); }
  double end() const { return dense.curve.end(); }
};

/// Control points of sections put together: each joint needs two fewer.
int pointsOf(const std::vector<MadeSection>& made) {
  int points = 2;
  for (const MadeSection& one : made) points += one.now.curve.controlPointCount() - 2;
  return points;
}

/// A section, or where none is lighter than it and it can be cut once more, its parts.
std::vector<MadeSection> lightenSection(const Section&, double diagonal, const LightOptions&, int extremaPerSection,
                                        const RunContext&);

std::optional<std::vector<Section>> cutAt(const Section& whole, const std::vector<double>& cuts,
                                          const RunContext& context) {
  std::vector<Section> parts;
  NurbsCurve rest = whole.dense;
  for (const double u : cuts) {
    if (context.isCancelled()) return std::nullopt;
    auto halves = split(rest, u);
    if (!halves) return std::nullopt;
    parts.push_back({std::move(halves->left)});
    rest = std::move(halves->right);
  }
  parts.push_back({std::move(rest)});
  parts.front().start = whole.start;
  parts.back().end = whole.end;
  return parts;
}

std::vector<MadeSection> lightenSection(const Section& section, double diagonal, const LightOptions& options,
                                        int extremaPerSection, const RunContext& context) {
  LightCurve same{section.dense, {}};
  same.report.points = same.report.pointsBefore = section.dense.controlPointCount();
  same.report.obstacle = LightObstacle::NoNormal;
  if (context.isCancelled()) return {{same, same}};
  const auto reference = LightReference::make(section.dense, false, options.step, diagonal, context);
  if (!reference) return {{same, same}};
  LightOptions held = options;
  held.start = section.start;
  held.end = section.end;
  LightCurve one = searchLight(section.dense, *reference, held, {LightForms::Quintic}, context);
  const int fewer = extremaPerSection / 2;
  if (one.report.kind != LightKind::Dense || fewer == 0 || same.report.points < kWorthCutting)
    return {{std::move(same), std::move(one)}};
  const auto parts = cutAt(section, lightSections(section.dense, *reference, held, fewer).cuts, context);
  if (!parts || parts->size() < 2) return {{std::move(same), std::move(one)}};
  std::vector<MadeSection> made;
  for (const Section& part : *parts) {
    auto own = lightenSection(part, diagonal, options, fewer, context);
    std::move(own.begin(), own.end(), std::back_inserter(made));
  }
  if (pointsOf(made) >= same.report.points) return {{std::move(same), std::move(one)}};
  return made;
}

CurvatureCounts countsOf(const NurbsCurve& curve, double size, bool closed, const RunContext& context) {
  return curvatureCounts(curve, kExtremumProminence / size, closed, context);
}

/// Whether the curvature turns back just where one curve goes over into the next.
bool turnsBack(const NurbsCurve& before, const NurbsCurve& after) {
  const double left = curvatureSlope(before, before.end()).value_or(0.0);
  const double right = curvatureSlope(after, after.start()).value_or(0.0);
  return left * right < 0.0;
}

/// Sections that made an extremum where they meet become dense again. @return whether there were any.
bool keepDenseAtKinks(std::vector<MadeSection>& made, bool closed) {
  bool any = false;
  const std::size_t count = made.size();
  for (std::size_t i = closed ? 0 : 1; i < count; ++i) {
    MadeSection &before = made[(i + count - 1) % count], &after = made[i];
    if (!turnsBack(before.now.curve, after.now.curve) || turnsBack(before.dense.curve, after.dense.curve)) continue;
    for (MadeSection* section : {&before, &after}) {
      if (section->isDense()) continue;
      section->now = section->dense;
      section->now.report.obstacle = LightObstacle::Structure;
      any = true;
    }
  }
  return any;
}

/// The part of a report that adds up.
void addTo(LightReport& sum, const LightReport& one) {
  sum.worst = std::max(sum.worst, one.worst);
  sum.iterations += one.iterations;
  sum.tries += one.tries;
  sum.sectionsDense += one.kind == LightKind::Dense ? 1 : 0;
  if (one.kind == LightKind::Dense) sum.obstacle = one.obstacle;
}

/// The part of a curve between two parameters.
std::optional<NurbsCurve> partOf(const NurbsCurve& curve, double from, double to) {
  NurbsCurve part = curve;
  if (to < part.end()) {
    auto halves = split(part, to);
    if (!halves) return std::nullopt;
    part = std::move(halves->left);
  }
  if (from > part.start()) {
    auto halves = split(part, from);
    if (!halves) return std::nullopt;
    part = std::move(halves->right);
  }
  return part;
}

/// Sections side by side that stay dense are not cut.
std::optional<LightCurve> assembled(const std::vector<MadeSection>& made, const NurbsCurve& dense,
                                    const RunContext& context) {
  LightCurve chain;
  chain.report.kind = LightKind::Chain;
  chain.report.sections = static_cast<int>(made.size());
  std::vector<NurbsCurve> curves;
  for (const MadeSection& one : made) {
    addTo(chain.report, one.now.report);
  }
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (context.isCancelled()) return std::nullopt;
    if (!made[i].isDense()) {
      curves.push_back(made[i].now.curve);
      continue;
    }
    const double from = made[i].start();
    while (i + 1 < made.size() && made[i + 1].isDense()) ++i;
    auto part = partOf(dense, from, made[i].end());
    if (!part) return std::nullopt;
    curves.push_back(std::move(*part));
  }
  if (chain.report.sectionsDense == chain.report.sections) return std::nullopt;
  auto joined = joinedWithTangents(curves);
  if (!joined) return std::nullopt;
  chain.curve = std::move(*joined);
  return chain;
}

}  // namespace

LightSections lightSections(const NurbsCurve& dense, const LightReference& reference, const LightOptions& options,
                            int extremaPerSection) {
  LightSections sections;
  const auto kept = significantExtrema(rankedExtrema(reference, kRankedProminence / reference.diagonal()),
                                       options.significance * options.tolerance);
  sections.extrema = static_cast<int>(kept.size());
  const std::vector<double> joined = joinedKnots(dense);
  std::vector<double> cuts = joined, at = arcLengthsAt(reference, joined);
  std::sort(at.begin(), at.end());
  int since = 0;
  for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
    ++since;
    const auto beyond = std::upper_bound(at.begin(), at.end(), kept[i].s);
    const bool joinedBetween = beyond != at.end() && *beyond <= kept[i + 1].s;
    if (joinedBetween) since = 0;
    if (since < extremaPerSection) continue;
    cuts.push_back(steepest(reference, kept[i].s, kept[i + 1].s));
    since = 0;
  }
  const double least =
      kFewestSamplesOfCut * (dense.end() - dense.start()) / static_cast<double>(std::max(1, reference.size()));
  sections.cuts = spread(std::move(cuts), dense, least);
  const std::vector<double> added = cutsOfLongStretches(sections.cuts, dense);
  if (!added.empty()) {
    sections.cuts.insert(sections.cuts.end(), added.begin(), added.end());
    sections.cuts = spread(std::move(sections.cuts), dense, least);
  }
  return sections;
}

std::optional<NurbsCurve> joinedWithTangents(const std::vector<NurbsCurve>& parts) {
  std::vector<double> knots(kQuinticChain + 1, 0.0);
  std::vector<Vec2> points;
  double from = 0.0, speed = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const NurbsCurve& part = parts[i];
    if (part.degree() != kQuinticChain || part.isRational()) return std::nullopt;
    const Vec2 first = part.derivatives(part.start(), 1)[1], last = part.derivatives(part.end(), 1)[1];
    double stretch = 1.0;
    if (i > 0) {
      const Vec2 before = parts[i - 1].derivatives(parts[i - 1].end(), 1)[1];
      if (!(std::abs(cross(before.normalized(), first.normalized())) < kSameTangent) || before.dot(first) <= 0.0) {
        return std::nullopt;
      }
      stretch = first.norm() / speed;
      if (stretch < kMostStretch && stretch > 1.0 / kMostStretch) {
        // The joint's own point lies on the line between its neighbours: with one speed it is not needed.
        points.pop_back();
      } else {
        stretch = 1.0;
        knots.push_back(from);
      }
    }
    speed = last.norm() / stretch;
    const auto own = part.controlPoints();
    points.insert(points.end(), own.begin() + (i > 0 ? 1 : 0), own.end());
    const auto ownKnots = part.knots();
    for (std::size_t k = kQuinticChain + 1; k + kQuinticChain + 1 < ownKnots.size(); ++k) {
      knots.push_back(from + stretch * (ownKnots[k] - part.start()));
    }
    from += stretch * (part.end() - part.start());
    knots.insert(knots.end(), i + 1 == parts.size() ? kQuinticChain + 1 : kQuinticChain - 1, from);
  }
  auto joined = NurbsCurve::make(kQuinticChain, std::move(knots), std::move(points));
  return joined ? std::optional(std::move(*joined)) : std::nullopt;
}

std::optional<LightCurve> lightChain(const NurbsCurve& dense, const LightReference& reference,
                                     const LightSections& sections, const LightOptions& options,
                                     const RunContext& context) {
  const bool closed = reference.isClosed();
  Section whole{dense};
  if (!closed) {
    whole.start = options.start;
    whole.end = options.end;
  }
  const auto parts = cutAt(whole, sections.cuts, context);
  if (!parts) return std::nullopt;
  std::vector<std::vector<MadeSection>> madeOf(parts->size());
  parallelFor(context, static_cast<int>(madeOf.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      madeOf[i] = lightenSection((*parts)[i], reference.diagonal(), options, kExtremaPerSection, context);
    }
  });
  std::vector<MadeSection> made;
  for (auto& some : madeOf) std::move(some.begin(), some.end(), std::back_inserter(made));
  if (context.isCancelled()) return std::nullopt;
  const CurvatureCounts most = countsOf(dense, extent(dense), closed, context);
  for (int round = 0; round < kChainRounds; ++round) {
    auto chain = assembled(made, dense, context);
    if (!chain) return std::nullopt;
    const CurvatureCounts counts =
        countsOf(chain->curve, std::max(extent(chain->curve), extent(dense)), closed, context);
    if (context.isCancelled()) return std::nullopt;
    if (counts.extrema > most.extrema || counts.inflections > most.inflections) {
      if (!keepDenseAtKinks(made, closed)) return std::nullopt;
      continue;
    }
    chain->report.ranked = rankedExtrema(reference, kRankedProminence / reference.diagonal());
    chain->report.extremaAsked = sections.extrema;
    chain->report.extrema = counts.extrema;
    chain->report.inflections = counts.inflections;
    chain->report.points = chain->curve.controlPointCount() - (closed ? 1 : 0);
    chain->report.pointsBefore = dense.controlPointCount() - (closed ? dense.degree() : 0);
    if (chain->report.points >= chain->report.pointsBefore) return std::nullopt;
    return chain;
  }
  return std::nullopt;
}

}  // namespace batten
