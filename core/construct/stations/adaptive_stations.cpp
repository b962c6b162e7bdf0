// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/stations/adaptive_stations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/base/number_text.h"
#include "core/base/statistics.h"
#include "core/contour/segment/station_meter.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

/// The tolerance speaks of the line, not of its noise: distances are averaged over this length.
constexpr double kAveragedPx = 5.0;
/// Closer stations would follow the pixels.
constexpr double kClosestPx = 3.0;
/// Means over 5 px leave a true line by so many times the noise of a point.
constexpr double kNoises = 1.5;
/// What lies as many times the limit away is told: less is no news.
constexpr double kTold = 1.1;
/// A gap between the points as long as this part of an interval leaves too few of them for its halves.
constexpr double kGapShare = 0.34;
constexpr int kMostRounds = 10;              // each may halve every interval: the tenth makes a thousandth of it
constexpr std::size_t kMostStations = 2000;  // of a piece: bounds its equations, and the time they take

/// Noise [px] of points that stand evenly: what the third differences, across the line, tell of it.
double noiseOf(const MeasuredPiece& piece) {
  constexpr double kThirdDifferences = 20.0;  // 1 + 9 + 9 + 1: their variance, in those of a point
  std::vector<double> sizes;
  for (int i = 0; i + 3 < piece.count(); ++i) {
    const Vec2 chord = piece.point(i + 3) - piece.point(i), inner = piece.point(i + 2) - piece.point(i + 1);
    if (chord.norm() > 0.0) sizes.push_back(std::abs(cross(chord.normalized(), chord - 3.0 * inner)));
  }
  return robustSigma(sizes) / std::sqrt(kThirdDifferences);
}

/// The least box around points.
struct PointBox {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  void add(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double squareFrom(const Vec2& p) const { return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm(); }
};

/// A polyline [px] in parts, with boxes that tell which of them cannot be the nearest to a point.
class BoxedLine {
 public:
  explicit BoxedLine(std::span<const Vec2> points) : points_(points) {
    const std::size_t segments = points.empty() ? 0 : points.size() - 1;
    for (std::size_t first = 0; first < segments; first += kPartSegments) {
      Part part{{}, first, std::min(first + kPartSegments, segments)};
      for (std::size_t i = first; i <= part.last; ++i) part.box.add(points[i]);
      box_.add(part.box.low);
      box_.add(part.box.high);
      parts_.push_back(part);
    }
  }

  /// What is nearest to a point so far: the square of its distance, and on which side of it the point lies.
  struct Nearest {
    double square = std::numeric_limits<double>::infinity(), side = 1.0;
  };
  void look(const Vec2& p, Nearest& found) const {
    const auto isBeyond = [&](const PointBox& box) {
      return box.squareFrom(p) > (1.0 + kMarginShare) * found.square + kRoundingPx * kRoundingPx;
    };
    if (isBeyond(box_)) return;
    for (const Part& part : parts_) {
      if (isBeyond(part.box)) continue;
      for (std::size_t i = part.first; i < part.last; ++i) {
        const Vec2 &a = points_[i], &b = points_[i + 1];
        const double away = awayFromSegment(p, a, b).squaredNorm();
        if (away >= found.square) continue;
        found = {away, cross(b - a, p - a) < 0.0 ? -1.0 : 1.0};
      }
    }
  }

 private:
  static constexpr std::size_t kPartSegments = 4;                   // in one box
  static constexpr double kMarginShare = 1e-6, kRoundingPx = 1e-6;  // more than rounding makes of distances
  struct Part {
    PointBox box;
    std::size_t first, last;  ///< Segments.
  };
  std::span<const Vec2> points_;
  PointBox box_;
  std::vector<Part> parts_;
};

/// Measures along the points of a piece how far they lie from the curve through its stations. All in px.
class Refiner {
 public:
  Refiner(const ConstructPiece& piece, StationSet start, double tolerancePx)
      : meter_(piece), given_(piece), set_(std::move(start)) {
    limitPx_ = std::max(tolerancePx, kNoises * noiseOf(meter_));
  }

  /// Arc lengths of the stations; false where the points do not go along with them.
  bool placeStations() {
    const std::size_t n = set_.stations.size();
    std::vector<double> run = {0.0};
    for (std::size_t i = 1; i < n; ++i) run.push_back(run.back() + (stationAt(i) - stationAt(i - 1)).norm());
    if (given_.closed) run.push_back(run.back() + (stationAt(0) - stationAt(n - 1)).norm());
    if (!(run.back() > 0.0) || !(meter_.length() > 0.0)) return false;
    const double scale = meter_.length() / run.back();
    const double reach = 2.0 * meter_.length() / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double guess = (i > 0 ? s_.front() : 0.0) + scale * run[i];
      std::optional<double> s;
      if (set_.stations[i].along) s = *set_.stations[i].along * meter_.length();
      // A station at a free end stands for it, however far from it a turn there has put it.
      if (!given_.closed && (i == 0 || i + 1 == n)) s = i == 0 ? 0.0 : meter_.length();
      if (!s) {
        s = i > 0 ? nearest(stationAt(i), guess - reach, guess + reach) : nearest(stationAt(i), 0.0, meter_.length());
      }
      if (i > 0 && !(*s > s_.back() + 1e-6 * meter_.length())) return false;
      s_.push_back(*s);
    }
    return !given_.closed || s_.back() < s_.front() + meter_.length();
  }

  /// How far the points lie from the curve; false where it is no curve through the stations.
  bool measure(std::vector<std::vector<Vec2>> curve) {
    if (curve.size() != s_.size() - (given_.closed ? 0 : 1)) return false;
    for (auto& line : curve) {
      if (!std::all_of(line.begin(), line.end(), [](const Vec2& p) { return p.allFinite(); })) return false;
    }
    away_.clear();
    excess_ = 0.0;
    set_.missedPx.reset();
    const std::vector<BoxedLine> lines(curve.begin(), curve.end());
    for (std::size_t i = 0; i < curve.size(); ++i) {
      away_.push_back(worst(lines, i));
      if (away_[i] > kTold * limitPx_) set_.missedPx = std::max(set_.missedPx.value_or(0.0), away_[i]);
      excess_ += length(i) * std::pow(std::max(0.0, away_[i] - limitPx_), 2);
    }
    return true;
  }
  /// What `measure` found beyond the limit, over the whole piece.
  double excess() const { return excess_; }

  /// Halves the intervals whose curve leaves the points; false if there was none.
  bool divide() {
    std::vector<char> halved(away_.size(), 0);
    for (std::size_t i = 0; i < halved.size(); ++i) halved[i] = away_[i] > limitPx_ && mayHalve(i);
    grade(halved);
    const std::size_t more = std::count(halved.begin(), halved.end(), 1);
    if (more == 0 || s_.size() + more > kMostStations) return false;
    insert(halved);
    return true;
  }

  const StationSet& set() const { return set_; }

 private:
  Vec2 stationAt(std::size_t i) const { return set_.stations[i].point; }
  double end(std::size_t i) const { return i + 1 < s_.size() ? s_[i + 1] : s_.front() + meter_.length(); }
  double length(std::size_t i) const { return end(i) - s_[i]; }

  /// True where both halves keep points to be measured from.
  bool mayHalve(std::size_t i) const {
    if (length(i) < 2.0 * kClosestPx) return false;
    int k = meter_.lowerBound(s_[i]), last = meter_.lowerBound(end(i));
    if (!given_.closed) last = std::min(last, meter_.count() - 1);
    for (; k < last; ++k) {
      if (meter_.s(k + 1) - meter_.s(k) > std::max(kClosestPx, kGapShare * length(i))) return false;
    }
    return true;
  }

  double nearest(const Vec2& p, double from, double to) const {
    int first = meter_.lowerBound(from), last = meter_.lowerBound(to);
    if (!given_.closed) {
      first = std::clamp(first, 0, meter_.count() - 1);
      last = std::clamp(last, 0, meter_.count() - 1);
    }
    int best = first;
    for (int i = first; i <= last; ++i) {
      if ((meter_.point(i) - p).squaredNorm() < (meter_.point(best) - p).squaredNorm()) best = i;
    }
    return meter_.s(best);
  }

  /// Largest distance [px] of an interval's points from the curve, in the mean over a few px.
  double worst(const std::vector<BoxedLine>& curve, std::size_t interval) const {
    const std::size_t n = curve.size();
    const BoxedLine& own = curve[interval];
    const BoxedLine* before = interval > 0 || given_.closed ? &curve[(interval + n - 1) % n] : nullptr;
    const BoxedLine* after = interval + 1 < n || given_.closed ? &curve[(interval + 1) % n] : nullptr;
    const auto distanceOf = [&](const Vec2& p) {
      BoxedLine::Nearest nearest;
      for (const BoxedLine* line : {&own, before, after})
        if (line) line->look(p, nearest);
      return nearest.side * std::sqrt(nearest.square);
    };
    int i = meter_.lowerBound(s_[interval]), last = meter_.lowerBound(end(interval));
    if (!given_.closed) last = std::min(last, meter_.count() - 1);
    // Blocks of equal length: a short one left over at the end would be a mean over too little.
    const double block = length(interval) / std::max(1.0, std::floor(length(interval) / kAveragedPx));
    double largest = 0.0;
    for (double until = s_[interval] + block; i <= last; until += block) {
      double sum = 0.0;
      int count = 0;
      for (; i <= last && (meter_.s(i) < until || until > end(interval) - 0.5 * block); ++i, ++count) {
        sum += distanceOf(meter_.point(i));
      }
      if (count > 0) largest = std::max(largest, std::abs(sum / count));
    }
    return largest;
  }

  /// Neighbouring intervals are to be halved as often but for one time.
  void grade(std::vector<char>& halved) const {
    const std::size_t n = halved.size();
    const auto after = [&](std::size_t i) { return set_.stations[i].halvings + halved[i]; };
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < n; ++i) {
        for (const std::size_t j : {(i + 1) % n, (i + n - 1) % n}) {
          const bool apart = !given_.closed && (j > i ? j - i : i - j) != 1;
          if (apart || after(i) + 1 >= after(j) || halved[i] || !mayHalve(i)) continue;
          halved[i] = 1;
          changed = true;
        }
      }
    }
  }

  void insert(const std::vector<char>& halved) {
    std::vector<double> s;
    std::vector<SpacedStation> stations;
    std::vector<char> anew;
    for (std::size_t i = 0; i < s_.size(); ++i) {
      const bool before = i > 0 ? halved[i - 1] : given_.closed && halved.back();
      const bool after = i < halved.size() && halved[i];
      s.push_back(s_[i]);
      SpacedStation& here = stations.emplace_back(set_.stations[i]);
      here.halvings += after ? 1 : 0;
      anew.push_back(before || after);
      if (!after) continue;
      s.push_back(0.5 * (s_[i] + end(i)));
      const int halvings = here.halvings;
      stations.emplace_back().halvings = halvings;
      anew.push_back(1);
      ++set_.added;
    }
    s_ = std::move(s);
    set_.stations = std::move(stations);
    for (std::size_t i = 0; i < s_.size(); ++i) {
      if (anew[i]) static_cast<Station&>(set_.stations[i]) = measured(i);
    }
    shareOut();
  }

  Station measured(std::size_t i) const {
    const std::size_t n = s_.size();
    const bool first = i == 0 && !given_.closed, last = i + 1 == n && !given_.closed;
    const double before = first ? length(i) : length((i + n - 1) % n), after = last ? before : length(i);
    Station station = makeStation(meter_, s_[i], std::min(before, after)).station;
    if (first && given_.startIsCorner) station.point = meter_.point(0);
    if (last && given_.endIsCorner) station.point = meter_.point(meter_.count() - 1);
    return station;
  }

  void shareOut() {
    const std::size_t n = s_.size();
    const auto share = [&](std::size_t interval) { return std::exp2(-set_.stations[interval].halvings); };
    for (std::size_t i = 0; i < n; ++i) {
      const bool first = i == 0 && !given_.closed, last = i + 1 == n && !given_.closed;
      const double before = first ? share(i) : share((i + n - 1) % n), after = last ? before : share(i);
      set_.stations[i].share = std::sqrt(before * after);
    }
  }

  MeasuredPiece meter_;
  const ConstructPiece& given_;
  StationSet set_;
  double limitPx_ = 0.0, excess_ = 0.0;
  std::vector<double> s_;     ///< [px] per station, increasing.
  std::vector<double> away_;  ///< [px] per interval: how far the points lie from the curve.
};

}  // namespace

StationSet givenStations(std::vector<Station> stations) {
  StationSet set;
  for (Station& station : stations) set.stations.push_back({std::move(station)});
  return set;
}

StationSet adaptiveStations(const ConstructPiece& piece, StationSet start, double tolerancePx,
                            const CurveThrough& curve, const RunContext& context) {
  // Hardly more points than stations: there is nothing to measure closer.
  const bool fewPoints = piece.points.size() < 2 * start.stations.size();
  if (!(tolerancePx > 0.0) || fewPoints) return start;
  if (start.stations.size() < (piece.closed ? 3u : 2u)) return start;
  if (!std::ranges::all_of(piece.points, [](const PiecePoint& p) { return p.at.allFinite(); })) return start;
  Refiner refiner(piece, start, tolerancePx);
  if (!refiner.placeStations()) return start;
  std::optional<StationSet> best;
  double least = 0.0;
  for (int round = 0; round <= kMostRounds && !context.isCancelled(); ++round) {
    if (!refiner.measure(curve(refiner.set()))) break;
    if (!best || refiner.excess() < least) {
      best = refiner.set();
      least = refiner.excess();
    }
    if (!refiner.divide()) break;
  }
  return best ? *best : start;
}

std::string maxDeviationNote(const StationSet& set) {
  if (!set.missedPx) return {};
  return "The curve leaves the line by about " + roundedText(*set.missedPx, 1) +
         " px, more than \"Maximum deviation\" allows. Mark sharp corners, or use the true and "
         "fair fit.";
}

}  // namespace batten
