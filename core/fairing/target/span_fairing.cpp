// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/span_fairing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/interpolation.h"
#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/profile/polynomial_fit.h"
#include "core/fairing/profile/profile_data.h"
#include "core/fairing/profile/target_degrees.h"
#include "core/fairing/target/natural_spans.h"
#include "core/fairing/target/shape_modification.h"

namespace batten {
namespace {

/// Knot intervals in a span that is to move: those at its ends are held, by the degree's number in all.
constexpr int kLeastIntervals = 16;
/// Of the mean knot interval: a knot nearer to another one is the same.
constexpr double kSameKnot = 0.05;
/// Cubic pieces that stand for a target polynomial.
constexpr int kNodesPerSpan = 60;

/// The curve's own curvature over the perimeter, with its slopes.
class OwnProfile {
 public:
  OwnProfile(const CurvatureSamples& samples, bool closed) : samples_(samples), closed_(closed) {}

  double at(double f) const { return linearBetween(samples_.kappa, place(f) * intervals()); }
  double slope(double f) const {
    const double h = 1.0 / intervals(), low = std::max(f - h, closed_ ? f - h : 0.0),
                 high = std::min(f + h, closed_ ? f + h : 1.0);
    return (at(high) - at(low < 0.0 ? low + 1.0 : low)) / (high - low);
  }
  ProfileNode node(int i) const {
    const int count = samples_.count();
    const int before = i > 0 ? i - 1 : closed_ ? count - 2 : 0, after = i + 1 < count ? i + 1 : closed_ ? 1 : i;
    const double steps = (i > 0 || closed_ ? 1.0 : 0.0) + (i + 1 < count || closed_ ? 1.0 : 0.0);
    const double slope = (samples_.kappa[after] - samples_.kappa[before]) * intervals() / steps;
    return {samples_.perimeter(i), samples_.kappa[i], slope};
  }

 private:
  double intervals() const { return samples_.count() - 1.0; }
  static double place(double f) { return f > 1.0 ? f - 1.0 : f; }
  const CurvatureSamples& samples_;
  bool closed_;
};

bool liesIn(const ProfileSpan& span, double f) {
  return (f > span.from && f < span.to) || (f + 1.0 > span.from && f + 1.0 < span.to);
}

double powers(const std::vector<double>& c, double x, bool slope) {
  double v = 0.0;
  for (std::size_t k = c.size(); k-- > (slope ? 1 : 0);) v = v * x + c[k] * (slope ? static_cast<double>(k) : 1.0);
  return v;
}

/// How much of the polynomial there is at x in 0..1 of the span: none at an end that is held, where the curve cannot
/// turn its curvature at once, all of it soon behind.
struct Easing {
  bool atStart = true, atEnd = true;
  double value(double x) const { return part(atStart, x) * part(atEnd, 1.0 - x); }
  double slope(double x) const {
    return partSlope(atStart, x) * part(atEnd, 1.0 - x) - part(atStart, x) * partSlope(atEnd, 1.0 - x);
  }

 private:
  static constexpr double kReach = 0.2;  // of the span
  static double part(bool isHeld, double x) {
    if (!isHeld || x >= kReach) return 1.0;
    const double t = x / kReach;
    return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
  }
  static double partSlope(bool isHeld, double x) {
    if (!isHeld || x >= kReach) return 0.0;
    const double t = x / kReach;
    return 30.0 * t * t * (1.0 - t) * (1.0 - t) / kReach;
  }
};

/// A polynomial over the span, the curve's own curvature outside.
std::vector<ProfileNode> spanNodes(const CurvatureSamples& samples, bool closed, const ProfileSpan& span,
                                   const std::vector<double>& polynomial, const Easing& easing) {
  const OwnProfile own(samples, closed);
  std::vector<ProfileNode> nodes;
  for (int i = 0; i < samples.count(); ++i)
    if (!liesIn(span, samples.perimeter(i))) nodes.push_back(own.node(i));
  const double width = span.to - span.from;
  const auto inside = [&](double x) {
    const double f = span.from + x * width;
    const double share = easing.value(x), sketched = own.at(f), wanted = powers(polynomial, x, false);
    const double slope = share * powers(polynomial, x, true) / width + (1.0 - share) * own.slope(f) +
                         easing.slope(x) / width * (wanted - sketched);
    return ProfileNode{f > 1.0 ? f - 1.0 : f, share * wanted + (1.0 - share) * sketched, slope};
  };
  for (int i = 0; i <= kNodesPerSpan; ++i) nodes.push_back(inside(static_cast<double>(i) / kNodesPerSpan));
  if (span.to > 1.0) {
    const ProfileNode seam = inside((1.0 - span.from) / width);
    nodes.push_back({0.0, seam.value, seam.slope});
    nodes.push_back({1.0, seam.value, seam.slope});
  }
  // Where the span ends, a node of each side may lie; the order of both decides on which side the kink is.
  std::stable_sort(nodes.begin(), nodes.end(), [](const ProfileNode& a, const ProfileNode& b) { return a.f < b.f; });
  const auto same = [](const ProfileNode& a, const ProfileNode& b) { return b.f - a.f < 1e-12; };
  nodes.erase(std::unique(nodes.begin(), nodes.end(), same), nodes.end());
  return nodes;
}

/// Parameters at which the span begins and ends; of a closed curve the second may lie beyond the end.
ProfileSpan parametersOf(const NurbsCurve& curve, const ProfileSpan& span) {
  const ArcLength arc(curve);
  const auto at = [&](double f) {
    const double lap = f > 1.0 ? curve.end() - curve.start() : 0.0;
    return arc.parameter((f > 1.0 ? f - 1.0 : f) * arc.total()) + lap;
  };
  return {at(span.from), at(span.to)};
}

/// Knots at the ends of the span, and in it until there are enough.
Result<NurbsCurve> refined(NurbsCurve curve, const ProfileSpan& range) {
  const double period = curve.end() - curve.start();
  const auto inDomain = [&](double u) { return u > curve.end() ? u - period : u; };
  const auto insert = [&](double u) -> Result<void> {
    auto more = insertKnot(curve, u, 1);
    if (!more) return fail(more.error());
    curve = std::move(*more);
    return {};
  };
  const double same = kSameKnot * period / static_cast<double>(curve.breaks().size());
  for (const double end : {range.from, range.to}) {
    const double u = inDomain(end);
    const auto breaks = curve.breaks();
    const bool isThere = std::any_of(breaks.begin(), breaks.end(), [&](double b) { return std::abs(b - u) < same; });
    if (isThere) continue;
    if (auto done = insert(u); !done) return fail(done.error());
  }
  for (int round = 0; round < kLeastIntervals; ++round) {
    int count = 0;
    double widest = 0.0, middle = 0.0;
    const auto breaks = curve.breaks();
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double at = 0.5 * (breaks[i] + breaks[i + 1]), width = breaks[i + 1] - breaks[i];
      if (!((at > range.from && at < range.to) || (at + period > range.from && at + period < range.to))) continue;
      ++count;
      if (width > widest * (1.0 + 1e-9)) widest = width, middle = at;
    }
    if (count >= kLeastIntervals || !(widest > 0.0)) break;
    if (auto done = insert(middle); !done) return fail(done.error());
  }
  return curve;
}

}  // namespace

TargetSet fitSpanTargets(const NurbsCurve& curve, bool closed, const TargetParams& params, const ProfileSpan& span) {
  TargetSet set;
  const CurvatureSamples samples = sampledCurvature(curve, params.samples);
  set.samples = samples.places();
  const OwnProfile own(samples, closed);
  const double width = span.to - span.from;
  const int count = std::max(params.samples, 8);
  std::vector<double> x, kappa;
  for (int i = 0; i < count; ++i) {
    x.push_back(static_cast<double>(i) / (count - 1));
    kappa.push_back(own.at(span.from + x.back() * width));
  }
  const std::optional<double> start = closed || span.from > 0.0 ? std::optional(kappa.front()) : std::nullopt;
  const std::optional<double> end = closed || span.to < 1.0 ? std::optional(kappa.back()) : std::nullopt;
  const ProfileData data = profileData(x, kappa, extent(curve), TargetQuantity::Curvature);
  set.comparesCurvature = data.bendsBothWays;
  for (int degree = 1; degree <= kMostTargetDegree; ++degree) {
    TargetProfile& profile = set.profiles[degree - 1];
    profile.degree = degree;
    const std::vector<double> c = fitPinnedPolynomial(x, kappa, degree, params.monotone, start, end);
    if (c.empty()) {
      profile.problem = "No polynomial of this degree could be fitted.";
      continue;
    }
    std::vector<double> fitted;
    fitted.reserve(x.size());
    for (const double one : x) fitted.push_back(powers(c, one, false));
    profile.valid = true;
    profile.isMonotone = isMonotonePolynomial(c);
    profile.nodes = spanNodes(samples, closed, span, c, {start.has_value(), end.has_value()});
    judgeProfile(profile, data, fitted, std::max(1, degree - (start ? 1 : 0) - (end ? 1 : 0)),
                 curve.controlPointCount());
    const std::optional<int> best = set.recommendedDegree;
    if (!best || hasLowerAicc(profile, set.profiles[*best - 1])) set.recommendedDegree = degree;
  }
  return set;
}

Result<std::shared_ptr<const FairingSetup>> makeSpanSetup(const NurbsCurve& curve, bool closed,
                                                          const FairingParams& params, const ProfileSpan& span,
                                                          CancelCheck check) {
  if (curve.isEmpty() || curve.isRational() || curve.degree() < 3 || curve.degree() > kMaxDegree)
    return makeSetup(curve, closed, params, check);  // which says what is wrong
  const ProfileSpan range = parametersOf(curve, span);
  auto finer = refined(curve, range);
  if (!finer) return fail(finer.error());
  auto setup = makeSetup(*finer, closed, params, check, range);
  if (setup && (*setup)->seamMm > 0.0) {
    return fail(ErrorCode::Numerical,
                "A single span of this closed curve cannot be moved because the curve is not periodic. "
                "Choose a target for the whole curve.");
  }
  if (setup && (*setup)->unknowns.count() == 0)
    return fail(ErrorCode::Numerical, "This span is too short to be moved on its own. Join it with its neighbour.");
  return setup;
}

Result<FairedCurve> fairSpans(const NurbsCurve& curve, bool closed, const std::vector<double>& splits,
                              const FairingParams& params, const RunContext& context) {
  FairedCurve result;
  result.curve = curve;
  std::vector<std::pair<ProfileSpan, int>> wanted;
  for (const SpanTarget& one : params.spanTargets) {
    const ProfileSpan span = spanBetween(splits, one.at, closed);
    std::erase_if(wanted, [&](const auto& earlier) { return earlier.first == span; });
    wanted.emplace_back(span, one.degree);
  }
  for (const auto& [span, degree] : wanted) {
    if (context.isCancelled()) return cancelled();
    // What was moved before may have changed the length, but no parameter.
    const ProfileSpan range = parametersOf(curve, span);
    const ArcLength arc(result.curve);
    const double period = curve.end() - curve.start();
    const auto shareOf = [&](double u) {
      return u > curve.end() ? 1.0 + arc.at(u - period) / arc.total() : arc.at(u) / arc.total();
    };
    const ProfileSpan now = result.curve == curve ? span : ProfileSpan{shareOf(range.from), shareOf(range.to)};
    const TargetSet targets = fitSpanTargets(result.curve, closed, params.targets, now);
    const TargetProfile& profile = targets.profiles[degree - 1];
    auto setup = makeSpanSetup(result.curve, closed, params, now, context);
    if (!setup && setup.error().code != ErrorCode::Numerical) return fail(setup.error());
    if (!setup || !profile.valid) {
      FairingReport stayed;
      stayed.why = Termination::Degenerate;
      stayed.note = setup ? profile.problem : setup.error().message;
      stayed.withinTolerance = false;
      addPart(result.report, stayed);
      continue;
    }
    const double tolerance = params.toleranceMm - (*setup)->takenMm;
    auto faired = tolerance > 0.0 ? modifyShape(*setup, profile, tolerance, context)
                                  : Result<FairedCurve>(withoutTolerance(result.curve, closed, params, context));
    if (!faired) return faired;
    if (std::optional<double>& needed = faired->report.neededMm; needed && *needed > 0.0) *needed += (*setup)->takenMm;
    addPart(result.report, faired->report);
    if (faired->report.maxDeviationMm > 0.0) result.curve = std::move(faired->curve);
  }
  result.report.extremaBefore = countedExtrema(curve, closed, context);
  result.report.extremaAfter = countedExtrema(result.curve, closed, context);
  if (context.isCancelled()) return cancelled();
  return result;
}

}  // namespace batten
