// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/fairing_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/sketch_deviation.h"

namespace batten {
namespace {

constexpr int kSamplesPerSpan = 4;  // where the objective is taken
/// Part of the tolerance that is kept for what lies between the places where the deviation is measured.
constexpr double kMeasured = 0.999;
/// A move that is too long is shortened to this part of what is allowed: the deviation is all but proportional to it,
/// and rounding must not make another round of it. Never to less than a hundredth at once.
constexpr double kShrinkRoom = 0.9995, kMostShrinking = 0.01;
constexpr int kMostShrinkings = 60;  // limits the work where nothing comes within
/// Of the extent: control points that differ by less are the same but for rounding.
constexpr double kSamePeriodic = 1e-8;
/// What may lie between the places where a distance is measured.
constexpr double kUnseenSeam = 1.01;

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
