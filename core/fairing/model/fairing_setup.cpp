// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/fairing_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing_report.h"

namespace batten {
namespace {

constexpr int kSamplesPerSpan = 4;                     // where the objective is taken
constexpr int kChecksPerSpan = 12, kMostChecks = 400;  // at least and at most, where speed and deviation are checked
/// Part of the tolerance that is kept for what lies between the places where the deviation is measured.
constexpr double kMeasured = 0.999;
constexpr double kUnseenShare = 0.01;  // of the largest distance, between the places where it is measured
/// A move that is too long is shortened to this part of what is allowed: the deviation is all but proportional to it,
/// and rounding must not make another round of it. Never to less than a hundredth at once.
constexpr double kShrinkRoom = 0.9995, kMostShrinking = 0.01;
constexpr int kMostShrinkings = 60;  // limits the work where nothing comes within
/// Of the extent: control points that differ by less are the same but for rounding.
constexpr double kSamePeriodic = 1e-8;
/// What may lie between the places where a distance is measured.
constexpr double kUnseenSeam = 1.01;
/// The same of a curve over fewer knots, whose places are not those of the sketched one.
constexpr double kUnseenOverFewerKnots = 1.015;
constexpr double kMostTurn = 0.5;  // [rad] of the curve from place to place

/// Largest distance of `count` + 1 equally spaced points of a span of `from` from their feet on `to`, a curve of
/// similar course; peaks between them by a parabola. `hint` says where on `to` a foot is looked for.
template <class Hint>
double largestInSpan(const SpanCurve& from, const SpanCurve& to, int span, int count, const Hint& hint) {
  double largest = 0.0, before = 0.0, here = 0.0;
  for (int i = 0; i <= count; ++i) {
    const SpanPlace place{span, static_cast<double>(i) / count};
    const Vec2 point = from.at(place, 0)[0];
    const double next = (to.at(footPoint(to, point, hint(place)), 0)[0] - point).norm();
    if (!std::isfinite(next)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, next);
    const double bend = before - 2.0 * here + next;
    if (i >= 2 && here >= before && here >= next && bend < 0.0) {
      largest = std::max(largest, here - (before - next) * (before - next) / (8.0 * bend));
    }
    before = here;
    here = next;
  }
  return largest;
}

/// In so many parts of a span the curve turns little.
double partsOfLittleTurn(const SpanCurve& from, int span) {
  const double slowest = from.speedRange(span, kChecksPerSpan).least;
  return from.bendBound(span) / (kMostTurn * slowest * from.basis().width(span));
}

int placesOf(double parts, int least) {
  const double count = std::ceil(parts);
  return count < kMostChecks ? std::max(static_cast<int>(count), least) : kMostChecks;
}

/// How closely a span must be looked at. Between places 1/n apart the difference of the curves bends away by no more
/// than its second derivative over 8 n^2; but where a curve turns about between two places, its distance may come and
/// go there.
int checksFor(const SpanCurve& from, const SpanCurve& to, int span, double largest) {
  const double apart = std::sqrt(from.bendBound(to, span) / (8.0 * kUnseenShare * largest));
  return placesOf(std::max({apart, partsOfLittleTurn(from, span), 0.0}), kChecksPerSpan);
}

/// So many places of a span that the curve turns little from one to the next.
int turnsFor(const SpanCurve& from, int span, int least) { return placesOf(partsOfLittleTurn(from, span), least); }

/// The span at whose middle two curves over one basis are farthest apart.
int farthestSpan(const SpanCurve& a, const SpanCurve& b) {
  double most = -1.0;
  int farthest = 0;
  for (int span = 0; span < a.basis().spanCount(); ++span) {
    const double apart = (a.at({span, 0.5}, 0)[0] - b.at({span, 0.5}, 0)[0]).squaredNorm();
    if (apart > most) most = apart, farthest = span;
  }
  return farthest;
}

/// Of two curves over one basis; no more than that it is more than `enough`, where it is.
double largestDistance(const SpanCurve& from, const SpanCurve& to, double enough, CancelCheck check) {
  const auto same = [](const SpanPlace& place) { return place; };
  double largest = 0.0;
  const int spans = from.basis().spanCount();
  const auto isMore = [&] { return largest > enough && std::isfinite(largest); };
  if (std::isfinite(enough) && !check.isCancelled())
    largest = largestInSpan(from, to, farthestSpan(from, to), kChecksPerSpan, same);
  for (int span = 0; span < spans && !isMore() && !check.isCancelled(); ++span)
    largest = std::max(largest, largestInSpan(from, to, span, kChecksPerSpan, same));
  if (!std::isfinite(largest)) return std::numeric_limits<double>::max();
  for (int span = 0; span < spans && largest > 0.0 && !isMore() && !check.isCancelled(); ++span) {
    const int checks = checksFor(from, to, span, largest);
    if (checks > kChecksPerSpan) largest = std::max(largest, largestInSpan(from, to, span, checks, same));
  }
  return std::isfinite(largest) ? largest : std::numeric_limits<double>::max();
}

/// Of a curve over fewer knots and the sketched one.
double largestDistanceOverFewerKnots(const FairingSetup& setup, const SpanCurve& curve, bool bothWays, double enough) {
  const int spans = setup.basis.spanCount(), sketched = setup.reference.basis().spanCount();
  const int checks = kChecksPerSpan * std::max(1, (sketched + spans - 1) / spans);
  double largest = 0.0;
  const auto isMore = [&] { return kUnseenOverFewerKnots * largest > enough && std::isfinite(largest); };
  for (int span = 0; span < spans && !isMore() && !setup.check.isCancelled(); ++span) {
    largest = std::max(largest, largestInSpan(curve, setup.reference, span, turnsFor(curve, span, checks),
                                              [&](const SpanPlace& place) { return setup.sketchedPlace(place); }));
  }
  const auto shareOf = [&](const SpanPlace& place) {
    return setup.sketch->sampleAt(place) / (setup.closed ? setup.sampleCount() : setup.sampleCount() - 1);
  };
  const auto placeAt = [&](double share) {
    const double u = setup.original.start() + share * (setup.original.end() - setup.original.start());
    int span = 0;
    while (span + 1 < spans && setup.basis.begin(span + 1) <= u) ++span;
    return SpanPlace{span, std::clamp((u - setup.basis.begin(span)) / setup.basis.width(span), 0.0, 1.0)};
  };
  for (int span = 0; bothWays && span < sketched && !isMore() && !setup.check.isCancelled(); ++span) {
    largest =
        std::max(largest, largestInSpan(setup.reference, curve, span, turnsFor(setup.reference, span, kChecksPerSpan),
                                        [&](const SpanPlace& place) { return placeAt(shareOf(place)); }));
  }
  return std::isfinite(largest) ? kUnseenOverFewerKnots * largest : std::numeric_limits<double>::max();
}

/// How far a periodic form is from the curve that it was made of; 0 where they differ by rounding only.
double distanceFrom(const NurbsCurve& curve, const PeriodicForm& form, CancelCheck check) {
  const auto periodic = fromPeriodic(form, curve);
  if (!periodic) return 0.0;
  double moved = 0.0;
  for (int i = 0; i < curve.controlPointCount(); ++i)
    moved = std::max(moved, (periodic->controlPoints()[i] - curve.controlPoints()[i]).norm());
  if (moved <= kSamePeriodic * extent(curve)) return 0.0;
  return kUnseenSeam * std::max(deviation(*periodic, curve, check).max, deviation(curve, *periodic, check).max);
}

/// Which control points a knot span that is not in the range depends on.
std::vector<bool> pointsOutside(const SpanBasis& basis, const ProfileSpan& range) {
  std::vector<bool> outside(basis.pointCount(), false);
  const int last = basis.spanCount() - 1;
  const double period = basis.begin(last) + basis.width(last) - basis.begin(0), rounding = 1e-9 * period;
  const auto isIn = [&](double u) { return u >= range.from - rounding && u <= range.to + rounding; };
  for (int span = 0; span <= last; ++span) {
    const double begin = basis.begin(span), end = begin + basis.width(span);
    if ((isIn(begin) && isIn(end)) || (isIn(begin + period) && isIn(end + period))) continue;
    for (int j = 0; j <= basis.degree(); ++j) outside[basis.point(span, j)] = true;
  }
  return outside;
}

/// Samples at equal arc length, so that the shortest span has its share too: what happens between samples is not felt
/// by the objective, and curves of few control points have short spans where they bend. Bounded where one span is a
/// sliver.
int samplesFor(const SpanBasis& basis) {
  const int spans = basis.spanCount();
  double whole = 0.0, shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < spans; ++i) {
    whole += basis.width(i);
    shortest = std::min(shortest, basis.width(i));
  }
  constexpr double kMostUneven = 8.0;  // times the mean: more samples are not made for the sake of one short span
  const double uneven = shortest > 0.0 ? std::clamp(whole / (shortest * spans), 1.0, kMostUneven) : kMostUneven;
  return static_cast<int>(std::ceil(kSamplesPerSpan * spans * uneven - 1e-6)) + 1;
}

}  // namespace

Result<std::shared_ptr<const FairingSetup>> makeSetup(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                                      CancelCheck check, const std::optional<ProfileSpan>& moving) {
  if (curve.isEmpty()) return fail(ErrorCode::BadParameter, "There is no curve to fair.");
  if (curve.isRational()) {
    return fail(ErrorCode::BadParameter, "Rational curves cannot be faired: set all weights to 1.");
  }
  if (curve.degree() < 3 || curve.degree() > kMaxDegree) {
    return fail(ErrorCode::BadParameter, "Only curves of degree 3 to 7 can be faired.");
  }
  auto setup = std::make_shared<FairingSetup>();
  setup->original = curve;
  setup->closed = closed;
  setup->check = check;
  setup->extent = extent(curve);
  setup->takenMm = params.takenMm;
  if (closed) {
    auto periodic = toPeriodic(curve);
    if (!periodic) return fail(periodic.error());
    setup->periodic = std::move(*periodic);
    setup->seamMm = distanceFrom(curve, setup->periodic, check);
    setup->points = setup->periodic.points;
    const int m = static_cast<int>(setup->points.size());
    setup->basis = SpanBasis(curve.degree(), setup->periodic.knots, m + curve.degree(), m);
  } else {
    setup->points.assign(curve.controlPoints().begin(), curve.controlPoints().end());
    setup->basis = SpanBasis(curve.degree(), curve.knots(), curve.controlPointCount(), 0);
  }
  setup->reference = SpanCurve(setup->basis, setup->points);
  const int samples = std::max(params.targets.samples, samplesFor(setup->basis));
  auto start = equalArcPlaces(setup->reference, samples, closed, check);
  if (!start || !(start->length > 1e-9 * setup->extent)) {
    return fail(ErrorCode::Numerical, "The curve has no length.");
  }
  setup->start = std::move(*start);
  setup->startHold = params.startHold;
  setup->endHold = params.endHold;
  setup->isPart = moving.has_value();
  const std::vector<bool> held = moving ? pointsOutside(setup->basis, *moving) : std::vector<bool>();
  setup->unknowns = Unknowns(setup->basis, setup->reference, params.startHold, params.endHold, held);
  return std::shared_ptr<const FairingSetup>(std::move(setup));
}

SpanPlace FairingSetup::sketchedPlace(const SpanPlace& place) const {
  if (!sketch) return place;
  const double share = (basis.parameter(place) - original.start()) / (original.end() - original.start());
  const int count = sampleCount(), sample = static_cast<int>(std::lround(share * (closed ? count : count - 1)));
  return start.places[closed ? sample % count : std::clamp(sample, 0, count - 1)];
}

double FairingSetup::sampleAt(const SpanPlace& place) const {
  if (sketch) return sketch->sampleAt(place);
  const double u = basis.parameter(place);
  const auto above =
      std::upper_bound(start.places.begin(), start.places.end(), u,
                       [&](double value, const SpanPlace& sample) { return value < basis.parameter(sample); });
  const int count = sampleCount(), next = static_cast<int>(above - start.places.begin());
  if (!closed && next == 0) return 0.0;
  if (!closed && next == count) return count - 1;
  const double period = original.end() - original.start();
  const auto parameterOf = [&](int i) { return basis.parameter(start.places[(i + count) % count]); };
  const double from = parameterOf(next - 1) - (next == 0 ? period : 0.0);
  const double to = parameterOf(next) + (next == count ? period : 0.0);
  const double share = to > from ? std::clamp((u - from) / (to - from), 0.0, 1.0) : 0.0;
  return next - 1 + share + (next == 0 ? count : 0);
}

double FairingSetup::offsetAt(const SpanPlace& foot) const {
  if (offsets.empty()) return 0.0;
  const double x = sampleAt(foot), below = std::floor(x);
  const int count = static_cast<int>(offsets.size()), i = static_cast<int>(below) % count;
  const int next = closed ? (i + 1) % count : std::min(i + 1, count - 1);
  return offsets[i] + (x - below) * (offsets[next] - offsets[i]);
}

Result<NurbsCurve> toCurve(const FairingSetup& setup, const std::vector<Vec2>& points) {
  if (!setup.closed) {
    return NurbsCurve::make(setup.original.degree(), {setup.original.knots().begin(), setup.original.knots().end()},
                            points);
  }
  PeriodicForm form = setup.periodic;
  form.points = points;
  return fromPeriodic(form, setup.original);
}

double largestDeviation(const FairingSetup& setup, const std::vector<Vec2>& points, bool bothWays, double enoughMm) {
  const SpanCurve curve(setup.basis, points);
  if (setup.sketch) return largestDistanceOverFewerKnots(setup, curve, bothWays, enoughMm);
  const double there = largestDistance(curve, setup.reference, enoughMm, setup.check);
  if (!bothWays || there > enoughMm) return there;
  return std::max(there, largestDistance(setup.reference, curve, enoughMm, setup.check));
}

FairedCurve withoutTolerance(const NurbsCurve& curve, bool closed, const FairingParams& params, CancelCheck check) {
  // a note
  constexpr const char* kSeamInTheWay =
      "Unchanged: making this closed curve periodic would move it by more than the tolerance.";
  constexpr const char* kAllTaken = "Unchanged: the tolerance is too small. Raise it.";  // a note
  auto kept = unchanged(curve, closed, Termination::Degenerate,
                        params.takenMm >= params.toleranceMm ? kAllTaken : kSeamInTheWay, check);
  kept.report.withinTolerance = false;
  return kept;
}

FairedCurve againstSketch(const FairingSetup& setup, FairedCurve faired) {
  if (std::optional<double>& needed = faired.report.neededMm; needed && *needed > 0.0) *needed += setup.claimedMm();
  if (!(setup.seamMm > 0.0)) return faired;
  const auto periodic = fromPeriodic(setup.periodic, setup.original);
  if (periodic && faired.curve == *periodic) {
    faired.curve = setup.original;
    faired.report.maxDeviationMm = 0.0;
    faired.report.extremaAfter = faired.report.extremaBefore;
    return faired;
  }
  faired.report.maxDeviationMm = std::max(deviation(faired.curve, setup.original, setup.check).max,
                                          deviation(setup.original, faired.curve, setup.check).max);
  return faired;
}

Result<FairedCurve> withSetup(
    const NurbsCurve& curve, bool closed, const FairingParams& params, const RunContext& context,
    const std::function<Result<FairedCurve>(const std::shared_ptr<const FairingSetup>&, const FairingParams&)>& body) {
  if (const auto error = validate(params)) return fail(*error);
  try {
    const auto setup = makeSetup(curve, closed, params, context);
    if (context.isCancelled()) return cancelled();
    if (!setup && setup.error().code != ErrorCode::Numerical) return fail(setup.error());
    if (!setup) return unchanged(curve, closed, Termination::Degenerate, setup.error().message, context);
    FairingParams within = params;
    within.toleranceMm -= (*setup)->claimedMm();
    if (!(within.toleranceMm > 0.0)) return withoutTolerance(curve, closed, params, context);
    auto faired = body(*setup, within);
    if (!faired) return faired;
    return againstSketch(**setup, std::move(*faired));
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to fair the curve.");
  }
}

double keepWithin(const FairingSetup& setup, double toleranceMm, std::vector<Vec2>& points) {
  const std::vector<Vec2> goal = points;
  double share = 1.0;
  // The deviation is all but proportional to the share, so that this ends after one or two rounds.
  for (int round = 0; round < kMostShrinkings && !setup.check.isCancelled(); ++round) {
    const double deviation = largestDeviation(setup, points, true);
    if (deviation <= kMeasured * toleranceMm) return deviation;
    share *= std::clamp(kShrinkRoom * kMeasured * toleranceMm / deviation, kMostShrinking, kShrinkRoom);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = setup.points[i] + share * (goal[i] - setup.points[i]);
  }
  points = setup.points;
  return 0.0;
}

Result<FairedCurve> finished(const FairingSetup& setup, std::vector<Vec2> points, double toleranceMm,
                             FairingReport report) {
  report.maxDeviationMm = keepWithin(setup, toleranceMm, points);
  auto curve = toCurve(setup, points);
  if (!curve) return fail(curve.error());
  report.extremaBefore = countedExtrema(setup.sketchedCurve(), setup.closed, setup.check);
  report.extremaAfter = countedExtrema(*curve, setup.closed, setup.check);
  return FairedCurve{std::move(*curve), std::move(report)};
}

}  // namespace batten
