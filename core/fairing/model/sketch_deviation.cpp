// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/sketch_deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/fairing/model/fairing_setup.h"

namespace batten {
namespace {

constexpr int kChecksPerSpan = 12, kMostChecks = 400;  // at least and at most, where speed and deviation are checked
constexpr double kUnseenShare = 0.01;  // of the largest distance, between the places where it is measured
/// Of a distance: a curve that is measured to be no farther than this is within it wherever it is measured.
constexpr double kClearlyWithin = 0.98;
/// Of the largest distance: where a curve is no farther, no peak between that place and the next one exceeds it.
constexpr double kClearlyNearer = 0.8;
/// What may lie between the places of a curve over fewer knots, which are not those of the sketched one.
constexpr double kUnseenOverFewerKnots = 1.015;
constexpr double kMostTurn = 0.5;  // [rad] of the curve from place to place

/// Looks for the place of a curve that is farthest from another one of similar course.
/// @tparam Hint says where on `to` the foot of a place is looked for.
template <class Hint>
class FarthestSearch {
 public:
  /// @param known places no farther are not told apart.
  FarthestSearch(const SpanCurve& from, const SpanCurve& to, double known, Hint hint)
      : from_(from), to_(to), hint_(std::move(hint)), largest_(known) {}

  double largest() const { return largest_; }
  /// Looks at `count` + 1 equally spaced places of a span, and at the peaks between them by a parabola. The feet of
  /// places that are clearly nearer than the farthest are not looked for. @return none of the places is farther.
  double look(int span, int count) {
    if (span != span_ + 1) ahead_ = 0.0;
    span_ = span;
    count_ = count;
    places_.assign(count + 1, {});
    double most = 0.0;
    for (int i = 0; i <= count; ++i) {
      findNearer(i, kClearlyNearer * largest_);
      if (!std::isfinite(places_[i].distance)) largest_ = std::numeric_limits<double>::infinity();
      most = std::max(most, places_[i].distance);
      if (places_[i].isFoot) largest_ = std::max(largest_, places_[i].distance);
    }
    for (int i = 1; i < count; ++i)
      if (places_[i].distance > kClearlyNearer * largest_) largest_ = std::max(largest_, peakAt(i));
    return most;
  }

 private:
  struct Place {
    double distance = 0.0;  ///< Of the foot, or no less than that.
    bool isFoot = false;
  };
  double distanceTo(const SpanPlace& place, const Vec2& point) const { return (to_.at(place, 0)[0] - point).norm(); }
  /// Finds the foot of a place, or that it is no farther than `enough`.
  void findNearer(int i, double enough) {
    if (places_[i].isFoot) return;
    const SpanPlace place{span_, static_cast<double>(i) / count_}, near = hint_(place);
    const double width = to_.basis().width(near.span);
    // The foot is likely to be as far ahead of the hint, in the parameter, as the foot before was; unless that is
    // another branch.
    const SpanPlace ahead{near.span, std::clamp(near.tau + ahead_ / width, 0.0, 1.0)};
    const Vec2 point = from_.at(place, 0)[0];
    const bool isAhead = ahead_ != 0.0 && distanceTo(ahead, point) <= distanceTo(near, point);
    const SpanPlace foot = footPoint(to_, point, isAhead ? ahead : near, enough);
    const double distance = distanceTo(foot, point);
    ahead_ = foot.span == near.span ? (foot.tau - near.tau) * width : 0.0;
    places_[i] = {distance, !(distance <= enough)};
  }
  double peakAt(int i) {
    for (const int k : {i - 1, i, i + 1}) findNearer(k, 0.0);
    const double before = places_[i - 1].distance, here = places_[i].distance, next = places_[i + 1].distance;
    const double bend = before - 2.0 * here + next;
    if (!(here >= before && here >= next && bend < 0.0)) return std::max({before, here, next});
    return here - (before - next) * (before - next) / (8.0 * bend);
  }

  const SpanCurve &from_, &to_;
  Hint hint_;
  double largest_, ahead_ = 0.0;
  int span_ = -1, count_ = 0;
  std::vector<Place> places_;
};

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
/// than its second derivative over 8 n^2, which must not lead beyond the largest distance from what is at the places
/// the most; but where a curve turns about between two places, its distance may come and go there.
int checksFor(const SpanCurve& from, const SpanCurve& to, int span, double most, double largest) {
  const double unseen = std::max(kUnseenShare * largest, largest - most);
  const double apart = std::sqrt(from.bendBound(to, span) / (8.0 * unseen));
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

/// Of two curves over one basis, or `known` where that is more; where it is more than `enough`, maybe less than all of
/// it, but more than that.
double largestDistance(const SpanCurve& from, const SpanCurve& to, double known, double enough, CancelCheck check) {
  FarthestSearch search(from, to, known, [](const SpanPlace& place) { return place; });
  const int spans = from.basis().spanCount();
  const auto isOver = [&] { return !(search.largest() <= enough) || check.isCancelled(); };
  // Where the largest distance is likely is looked first: the feet of all that is nearer need not be found.
  if (!isOver()) search.look(farthestSpan(from, to), kChecksPerSpan);
  std::vector<double> most(spans, 0.0);
  for (int span = 0; span < spans && !isOver(); ++span) most[span] = search.look(span, kChecksPerSpan);
  for (int span = 0; span < spans && search.largest() > 0.0 && !isOver(); ++span) {
    const int checks = checksFor(from, to, span, most[span], search.largest());
    if (checks > kChecksPerSpan) search.look(span, checks);
  }
  return std::isfinite(search.largest()) ? search.largest() : std::numeric_limits<double>::max();
}

/// Of a curve over fewer knots and the sketched one.
double largestDistanceOverFewerKnots(const FairingSetup& setup, const SpanCurve& curve, bool bothWays, double known,
                                     double enough) {
  constexpr double kRounding = 1.0 - 1e-12;  // what is known must be no more than `enough` when it comes back
  const int spans = setup.basis.spanCount(), sketched = setup.reference.basis().spanCount();
  const int checks = kChecksPerSpan * std::max(1, (sketched + spans - 1) / spans);
  const auto isOver = [&](double largest) {
    return !(kUnseenOverFewerKnots * largest <= enough) || setup.check.isCancelled();
  };
  FarthestSearch there(curve, setup.reference, known / kUnseenOverFewerKnots * kRounding,
                       [&](const SpanPlace& place) { return setup.sketchedPlace(place); });
  for (int span = 0; span < spans && !isOver(there.largest()); ++span) there.look(span, turnsFor(curve, span, checks));
  const auto shareOf = [&](const SpanPlace& place) {
    return setup.sketch->sampleAt(place) / (setup.closed ? setup.sampleCount() : setup.sampleCount() - 1);
  };
  const auto placeAt = [&](double share) {
    return setup.basis.place(setup.original.start() + share * (setup.original.end() - setup.original.start()));
  };
  FarthestSearch back(setup.reference, curve, there.largest(),
                      [&](const SpanPlace& place) { return placeAt(shareOf(place)); });
  for (int span = 0; bothWays && span < sketched && !isOver(back.largest()); ++span)
    back.look(span, turnsFor(setup.reference, span, kChecksPerSpan));
  return std::isfinite(back.largest()) ? kUnseenOverFewerKnots * back.largest() : std::numeric_limits<double>::max();
}

/// As largestDeviation(), or `known` where that is more.
double deviationOrKnown(const FairingSetup& setup, const std::vector<Vec2>& points, bool bothWays, double enough,
                        double known) {
  const SpanCurve curve(setup.basis, points);
  if (setup.sketch) return largestDistanceOverFewerKnots(setup, curve, bothWays, known, enough);
  const double there = largestDistance(curve, setup.reference, known, enough, setup.check);
  if (!bothWays || there > enough) return there;
  return largestDistance(setup.reference, curve, there, enough, setup.check);
}

}  // namespace

double largestDeviation(const FairingSetup& setup, const std::vector<Vec2>& points, bool bothWays, double enoughMm) {
  return deviationOrKnown(setup, points, bothWays, enoughMm, 0.0);
}

bool isClearlyWithin(const FairingSetup& setup, const std::vector<Vec2>& points, double mm) {
  const double known = kClearlyWithin * mm;
  return deviationOrKnown(setup, points, true, known, known) <= known;
}

}  // namespace batten
