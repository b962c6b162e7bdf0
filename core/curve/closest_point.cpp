// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/statistics.h"
#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/curve/foot_step.h"
#include "core/curve/sample_tree.h"
#include "core/curve/span_polynomials.h"
#include "core/solve/golden_section.h"

namespace batten {

namespace {

/// Local minimum of the distance within [low, high], from `start`: Newton on (R - p).R', never uphill.
ClosestPoint descend(const SpanPolynomials& curve, const Vec2& p, double start, double low, double high) {
  double u = std::clamp(start, low, high);
  auto d = curve.at(u);
  double squared = (d[0] - p).squaredNorm();
  const double smallest = 1e-13 * (curve.end() - curve.start());
  for (int iteration = 0; iteration < 30; ++iteration) {
    double step = std::clamp(u + footStep(d[0] - p, d[1], d[2]), low, high) - u;
    bool moved = false;
    while (std::abs(step) > smallest) {
      const auto trial = curve.at(u + step);
      const double trialSquared = (trial[0] - p).squaredNorm();
      if (trialSquared <= squared) {
        moved = trialSquared < squared;
        u += step;
        d = trial;
        squared = trialSquared;
        break;
      }
      step *= 0.25;
    }
    if (!moved) break;
  }
  return {u, std::sqrt(squared), d[0]};
}

}  // namespace

/// Sample points of a curve, fine enough that each local minimum of a distance has a start value: closer where the
/// curve turns about, so that no hairpin hides between two of them.
class StartTable {
 public:
  explicit StartTable(const NurbsCurve& curve, CancelCheck check = {}) : polynomials(curve) {
    const std::vector<double> breaks = curve.breaks();
    const int perSpan = 2 * curve.degree() + 2;
    for (std::size_t i = 0; i + 1 < breaks.size() && !check.isCancelled(); ++i) {
      const double step = (breaks[i + 1] - breaks[i]) / perSpan;
      auto from = polynomials.at(breaks[i]);
      add(breaks[i], from[0], true);
      for (int k = 1; k <= perSpan; ++k) {
        const double low = breaks[i] + step * (k - 1), high = k < perSpan ? breaks[i] + step * k : breaks[i + 1];
        const auto to = polynomials.at(high);
        addBetween(low, from, high, to, kDeepest);
        if (k < perSpan) add(high, to[0], false);
        from = to;
      }
    }
    add(curve.end(), polynomials.at(curve.end())[0], true);
    // Noted for the interval behind a place, it holds for the one before it as well.
    for (std::size_t i = size() - 1; i > 0; --i) places_[i].bulge = std::max(places_[i].bulge, places_[i - 1].bulge);
    tree_.emplace(std::move(places_));
  }
  std::size_t size() const { return u.size(); }
  const SampleTree& tree() const { return *tree_; }

  SpanPolynomials polynomials;
  std::vector<double> u;
  std::vector<char> isKnot;

 private:
  // How far a curve of moderate turn lies off its chord at the most, with some to spare: an arc a quarter of the slope
  // of its ends against the chord, of which the sag beside its middle tells, a double bend a tenth.
  static constexpr double kPerSag = 1.5, kPerSlope = 0.3;
  static constexpr double kPerChord = 1.5;    // of a chord of any turn
  static constexpr double kRounding = 1e-12;  // of the coordinates; some thousand times that of a place
  static constexpr int kDeepest = 6;          // halvings of a step
  static constexpr double kMostTurn = 0.87;   // cosine of half a radian
  static constexpr double kMostSag = 0.15;    // of the chord, beside its middle

  void add(double at, const Vec2& point, bool knot) {
    u.push_back(at);
    places_.push_back({point, 0.0});
    isKnot.push_back(knot ? 1 : 0);
  }
  void addBetween(double low, const std::array<Vec2, 3>& a, double high, const std::array<Vec2, 3>& b, int depth) {
    const double middle = 0.5 * (low + high), chord = (b[0] - a[0]).norm();
    places_.back().bulge = kPerChord * chord;
    if (depth == 0) return;
    const bool turns = !(a[1].dot(b[1]) >= kMostTurn * a[1].norm() * b[1].norm());
    const auto m = polynomials.at(middle);
    const double sag = (m[0] - 0.5 * (a[0] + b[0])).norm();
    if (!turns && sag <= kMostSag * chord) {
      // Half a chord on, the slopes of a moderate turn are those of its ends and its middle.
      double rise = 0.0;
      for (const Vec2& along : {a[1], m[1], b[1]}) {
        const double speed = along.norm();
        rise = std::max(rise, speed > 0.0 ? std::abs(cross(along, b[0] - a[0])) / speed : chord);
      }
      places_.back().bulge =
          std::min(places_.back().bulge, kPerSag * sag + kPerSlope * rise + kRounding * b[0].cwiseAbs().maxCoeff());
      return;
    }
    addBetween(low, a, middle, m, depth - 1);
    add(middle, m[0], false);
    addBetween(middle, m, high, b, depth - 1);
  }

  std::vector<CurvePlace> places_;  ///< Until the tree takes them.
  std::optional<SampleTree> tree_;
};

namespace {

ClosestPoint closestWith(const StartTable& table, const Vec2& p) {
  const SpanPolynomials& curve = table.polynomials;
  const std::vector<CurvePlace>& places = table.tree().places();
  const std::size_t n = table.size();
  const auto distanceOf = [&](std::size_t i) { return (places[i].point - p).norm(); };
  const auto refine = [&](std::size_t i) {
    const double low = table.u[i == 0 ? 0 : i - 1], here = table.u[i], high = table.u[std::min(i + 1, n - 1)];
    ClosestPoint found = descend(curve, p, here, low, high);
    if (!table.isKnot[i]) return found;
    // A knot may be a corner, where the derivatives tell of one side only.
    for (const ClosestPoint& side : {descend(curve, p, here - 0.25 * (here - low), low, here),
                                     descend(curve, p, here + 0.25 * (high - here), here, high)}) {
      if (side.distance < found.distance) found = side;
    }
    return found;
  };
  const std::size_t nearest = table.tree().nearest(p);
  ClosestPoint best = refine(nearest);
  table.tree().within(
      p, [&] { return best.distance; },
      [&](std::size_t i) {
        if (i == nearest) return;
        // Behind a corner another side begins, however the distance changes before it.
        const double here = distanceOf(i);
        const bool lowest = table.isKnot[i] != 0 ||
                            ((i == 0 || here <= distanceOf(i - 1)) && (i + 1 == n || here <= distanceOf(i + 1)));
        if (!lowest) return;
        const ClosestPoint other = refine(i);
        if (other.distance < best.distance) best = other;
      });
  return best;
}

/// Follows points along a curve: the closest point of one is the start value of the next.
class Follower {
 public:
  Follower(const NurbsCurve& curve, CancelCheck check)
      : table_(curve, check), closed_(meets(curve)), window_((curve.end() - curve.start()) / 4.0) {}

  ClosestPoint next(const Vec2& p) {
    ClosestPoint found;
    if (count_ == 0) {
      found = closestWith(table_, p);
    } else {
      found = descend(curve(), p, last_.u, std::max(curve().start(), last_.u - window_),
                      std::min(curve().end(), last_.u + window_));
      if (closed_) found = acrossSeam(p, found);
      constexpr double kFar = 3.0;  // times the root mean square of the distances so far
      const double possible = last_.distance + (p - lastPoint_).norm();
      const double usual = std::sqrt(sumSquares_ / count_);
      // A larger distance than any before is never taken on trust: a search that has lost its branch creeps away by no
      // more than is possible, and makes the large distance the usual one.
      if (found.distance > possible * (1.0 + 1e-9) || found.distance > kFar * usual || found.distance > largest_) {
        const ClosestPoint anywhere = closestWith(table_, p);
        if (anywhere.distance < found.distance) found = anywhere;
      }
    }
    ++count_;
    sumSquares_ += found.distance * found.distance;
    largest_ = std::max(largest_, found.distance);
    last_ = found;
    lastPoint_ = p;
    return found;
  }
  const StartTable& table() const { return table_; }

 private:
  static bool meets(const NurbsCurve& curve) {
    return (curve.point(curve.start()) - curve.point(curve.end())).norm() <= 1e-9 * extent(curve);
  }
  ClosestPoint acrossSeam(const Vec2& p, const ClosestPoint& found) const {
    ClosestPoint other = found;
    if (found.u >= curve().end())
      other = descend(curve(), p, curve().start(), curve().start(), curve().start() + window_);
    if (found.u <= curve().start()) other = descend(curve(), p, curve().end(), curve().end() - window_, curve().end());
    return other.distance < found.distance ? other : found;
  }

  const SpanPolynomials& curve() const { return table_.polynomials; }

  StartTable table_;
  bool closed_;
  double window_;
  ClosestPoint last_;
  Vec2 lastPoint_ = Vec2::Zero();
  int count_ = 0;
  double sumSquares_ = 0.0, largest_ = 0.0;
};

Deviation summary(std::span<const Vec2> points, std::vector<double> distances) {
  Deviation result;
  result.count = static_cast<int>(distances.size());
  if (distances.empty()) return result;
  double sum = 0.0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    sum += distances[i] * distances[i];
    if (i == 0 || distances[i] > result.max) {
      result.max = distances[i];
      result.worstPoint = points[i];
    }
  }
  const double count = static_cast<double>(distances.size());
  result.rms = std::sqrt(sum / count);
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * count)) - 1;
  result.percentile95 = elementOfRank(distances, rank);
  return result;
}

/// The distance of a curve's point at u from another curve.
struct DistanceAt {
  double u = 0.0, distance = 0.0;
};

/// The highest distances between places that are in order along `a`. Where one curve cuts a tight bend of the other,
/// the distance comes to a point between two places, and is sought there.
std::vector<DistanceAt> highestPeaks(std::vector<DistanceAt> places, const NurbsCurve& a, const StartTable& table,
                                     CancelCheck check) {
  constexpr std::size_t kPeaks = 8;  // that are looked at, the highest ones
  constexpr int kSteps = 20;         // of golden section: 1/15000 of two places
  std::vector<std::size_t> peaks;
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    const double here = places[i].distance;
    if (here >= places[i - 1].distance && here >= places[i + 1].distance) peaks.push_back(i);
  }
  const std::size_t count = std::min(kPeaks, peaks.size());
  std::partial_sort(peaks.begin(), peaks.begin() + static_cast<std::ptrdiff_t>(count), peaks.end(),
                    [&](std::size_t i, std::size_t j) {
                      return places[i].distance != places[j].distance ? places[i].distance > places[j].distance : i < j;
                    });
  std::vector<DistanceAt> found;
  for (std::size_t k = 0; k < count; ++k) {
    const auto nearness = [&](double u) { return -closestWith(table, a.point(u)).distance; };
    const ValueAt peak = goldenSection(nearness, places[peaks[k] - 1].u, places[peaks[k] + 1].u, kSteps, check);
    found.push_back({peak.at, -peak.value});
  }
  return found;
}

/// The distances of points that are in order along the curve; fewer where the work was cancelled.
std::vector<double> distancesAlong(Follower& follower, std::span<const Vec2> points, CancelCheck check) {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Vec2& p : points) {
    if (check.isCancelled()) break;
    distances.push_back(follower.next(p).distance);
  }
  return distances;
}

}  // namespace

ClosestPoint closestPoint(const NurbsCurve& curve, const Vec2& p) { return closestWith(StartTable(curve), p); }

ClosestPointFinder::ClosestPointFinder(const NurbsCurve& curve, CancelCheck check)
    : table_(std::make_shared<const StartTable>(curve, check)) {}
ClosestPoint ClosestPointFinder::closestTo(const Vec2& p) const { return closestWith(*table_, p); }
const std::vector<CurvePlace>& ClosestPointFinder::places() const { return table_->tree().places(); }

Deviation deviation(const NurbsCurve& curve, std::span<const Vec2> points, bool ordered, CancelCheck check) {
  if (ordered) {
    Follower follower(curve, check);
    std::vector<double> distances = distancesAlong(follower, points, check);
    return distances.size() < points.size() ? Deviation{} : summary(points, std::move(distances));
  }
  std::vector<double> distances;
  distances.reserve(points.size());
  const StartTable table(curve, check);
  for (const Vec2& p : points) {
    if (check.isCancelled()) return {};
    distances.push_back(closestWith(table, p).distance);
  }
  return summary(points, std::move(distances));
}

Deviation deviation(const NurbsCurve& a, const NurbsCurve& b, CancelCheck check) {
  const int spans = static_cast<int>(std::max(a.breaks().size(), b.breaks().size())) - 1;
  Follower follower(b, check);
  const std::vector<CurveSample> samples = sampleByArcLength(a, std::max(201, 10 * spans + 1), check);
  std::vector<Vec2> points;
  points.reserve(samples.size());
  for (const CurveSample& sample : samples) points.push_back(sample.point);
  const std::vector<double> distances = distancesAlong(follower, points, check);
  if (distances.size() < points.size()) return {};
  std::vector<DistanceAt> places;
  for (std::size_t i = 0; i < points.size(); ++i) places.push_back({samples[i].u, distances[i]});
  Deviation result = summary(points, distances);
  for (const DistanceAt& peak : highestPeaks(std::move(places), a, follower.table(), check)) {
    if (peak.distance <= result.max) continue;
    result.max = peak.distance;
    result.worstPoint = a.point(peak.u);
  }
  return result;
}

}  // namespace batten
