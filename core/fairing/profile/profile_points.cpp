// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/profile_points.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace batten {
namespace {

/// Intervals at whose ends the profile is compared with the target.
constexpr int kCompared = 1000;
/// Of the target's largest curvature.
constexpr double kCurvatureShare = 0.01;
/// Of the largest curvature: a target that turns back by less is flat.
constexpr double kFlatShare = 1e-3;
constexpr int kMostAdded = 25;  // one by one, to a profile
/// Of the length: nearer to another point, or to an end, no point is set.
constexpr double kLeastApart = 2.5e-3;
/// The same for places where the target turns back: several in one flat stretch are one.
constexpr double kTurnsApart = 1e-2;

double shareAt(int sample) { return static_cast<double>(sample) / kCompared; }

/// Places of points, and how far the profile through them is off the target.
class PointsOnTarget {
 public:
  PointsOnTarget(const TargetProfile& target, std::span<const double> splits, bool closed)
      : target_(target), closed_(closed) {
    for (int i = 0; i <= kCompared; ++i) kappa_.push_back(target.curvatureAt(shareAt(i)));
    for (const double one : kappa_) largest_ = std::max(largest_, std::abs(one));
    places_.push_back(0.0);
    if (!closed) places_.push_back(1.0);
    for (const double split : splits) addPlace(split, kLeastApart);
    addExtrema();
    if (places_.size() < 2) places_.push_back(0.5);
    lay();
  }

  const std::vector<ProfilePoint>& points() const { return points_; }

  bool isCurvatureMet() const { return isMet(left_); }

  /// [mm] How far the difference of curvature moves a curve whose ends stay: its integral, twice.
  double moveMm(double lengthMm) const {
    std::vector<double> moved{0.0};
    double turned = 0.0;
    const double step = lengthMm / kCompared;
    for (int i = 0; i < kCompared; ++i) {
      const double before = turned;
      turned += 0.5 * (left_[i] + left_[i + 1]) * step;
      moved.push_back(moved.back() + 0.5 * (before + turned) * step);
    }
    double most = 0.0;
    for (int i = 0; i <= kCompared; ++i) most = std::max(most, std::abs(moved[i] - shareAt(i) * moved.back()));
    return most;
  }

  /// One more point where the profile through points on the target is off most; where it is near enough, in the
  /// interval that turns too much or too little. False where there is no room.
  bool addWorst() {
    const bool isNear = isMet(off_);
    double worst = 0.0;
    std::optional<double> share;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const double end = k + 1 < places_.size() ? places_[k + 1] : 1.0;
      double sum = 0.0, highest = 0.0;
      std::optional<double> place;
      for (int i = 0; i <= kCompared; ++i) {
        const double f = shareAt(i);
        if (f < places_[k] + kLeastApart || f > end - kLeastApart) continue;
        sum += off_[i];
        if (std::abs(off_[i]) > highest) highest = std::abs(off_[i]), place = f;
      }
      const double badness = isNear ? std::abs(sum) : highest;
      if (place && badness > worst) worst = badness, share = place;
    }
    if (!share) return false;
    places_.insert(std::upper_bound(places_.begin(), places_.end(), *share), *share);
    lay();
    return true;
  }

 private:
  bool isMet(const std::vector<double>& off) const {
    return std::all_of(off.begin(), off.end(),
                       [this](double one) { return std::abs(one) <= kCurvatureShare * largest_; });
  }

  void addPlace(double share, double apart) {
    const bool isFree =
        share >= apart && share <= 1.0 - apart &&
        std::all_of(places_.begin(), places_.end(), [&](double other) { return std::abs(share - other) >= apart; });
    if (isFree && places_.size() < kMostProfilePoints - kMostAdded)
      places_.insert(std::upper_bound(places_.begin(), places_.end(), share), share);
  }

  /// A place wherever the target turns back by more than what rounding makes of a constant one.
  void addExtrema() {
    const double flat = kFlatShare * largest_;
    int farthest = 0;
    double direction = 0.0;
    for (int i = 1; i <= kCompared; ++i) {
      const double step = kappa_[i] - kappa_[farthest];
      if (direction != 0.0 && direction * step >= 0.0) {
        farthest = i;
      } else if (std::abs(step) > flat) {
        if (direction != 0.0) addPlace(shareAt(farthest), kTurnsApart);
        direction = step;
        farthest = i;
      }
    }
  }

  /// Points on the target, then moved so that the profile around each has the target's mean: between points the
  /// profile bends otherwise than the target, and what it turns too much would add up along the curve.
  void lay() {
    points_.clear();
    for (const double f : places_) points_.push_back({f, target_.curvatureAt(f)});
    off_ = differenceOf(points_);
    std::vector<ProfilePoint> moved = points_;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const double f = points_[k].fraction;
      const double low = k > 0 ? 0.5 * (points_[k - 1].fraction + f) : 0.0;
      const double high = 0.5 * (f + (k + 1 < points_.size() ? points_[k + 1].fraction : 1.0));
      double sum = 0.0;
      int count = 0;
      for (int i = 0; i <= kCompared; ++i)
        if (shareAt(i) >= low && shareAt(i) <= high) sum += off_[i], ++count;
      if (count > 0) moved[k].kappa -= sum / count;
    }
    points_ = std::move(moved);
    left_ = differenceOf(points_);
  }

  /// [1/mm] The profile through the points less the target, at the compared places.
  std::vector<double> differenceOf(const std::vector<ProfilePoint>& points) const {
    const TargetProfile drawn = drawnProfile(points, closed_);
    std::vector<double> off;
    for (int i = 0; i <= kCompared; ++i) off.push_back(drawn.curvatureAt(shareAt(i)) - kappa_[i]);
    return off;
  }

  const TargetProfile& target_;
  bool closed_;
  std::vector<double> kappa_;       ///< [1/mm] of the target at the compared places.
  std::vector<double> off_, left_;  ///< [1/mm] differences there: of points on the target, and of the moved points.
  double largest_ = 0.0;
  std::vector<double> places_;  ///< Ascending; closed: without 1.
  std::vector<ProfilePoint> points_;
};

}  // namespace

std::vector<ProfilePoint> pointsAlong(const TargetProfile& target, std::span<const double> splits, bool closed,
                                      double lengthMm, double moveMm) {
  if (!target.valid) return {};
  PointsOnTarget points(target, splits, closed);
  for (int i = 0; i < kMostAdded; ++i) {
    if (points.isCurvatureMet() && points.moveMm(lengthMm) <= moveMm) break;
    if (!points.addWorst()) break;
  }
  return points.points();
}

}  // namespace batten
