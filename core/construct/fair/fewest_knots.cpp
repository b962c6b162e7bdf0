// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fewest_knots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "core/construct/fair/fair_frame.h"
#include "core/curve/extremum_indices.h"
#include "core/curve/knot_operations.h"
#include "core/solve/banded_cholesky.h"
#include "core/solve/banded_matrix.h"
#include "core/solve/banded_program.h"

namespace batten {
namespace {

constexpr int kFewestClosed = 8;       // spans of a closed curve
constexpr double kLeastGain = 0.85;    // of the spans: more are not worth another curve
constexpr double kFirstGuess = 0.25;   // of the spans
constexpr int kTrials = 6;             // numbers of spans: each is a fit, of which the last ones gain little
constexpr double kCloseEnough = 0.06;  // of the spans: that many more or less are not worth a trial
// limits: what counts for other extrema than the full curve has, and for no fit
constexpr double kExtremaExcess = 1.6, kNoFit = 20.0;
constexpr double kLeastExcess = 0.05;     // taken of a fit: a trial then has half the spans at least (fourth root)
constexpr double kStraightenBelow = 1.5;  // excess of a fit that is worth another solution
constexpr int kFreeSpans = 1;             // of the full curve on either side of an extremum
constexpr double kEndHold = 1e4;          // relative weight of exact ends in the frame
constexpr double kMonitorFloor = 0.2;     // of the mean density of knots
constexpr double kWrongWayKept = 3e-3;    // [1/diagonal] curvature that may turn back
constexpr double kHoldWeight = 1e8;       // weight of what is set exactly afterwards

double kappaOf(const Vec2& first, const Vec2& second) {
  const double w = std::max(first.squaredNorm(), 1e-12);
  return cross(first, second) / (w * std::sqrt(w));
}

/// Parameters 0..length from 0..1 such that equal steps hold equal shares of the error of a quintic.
class KnotPlacing {
 public:
  explicit KnotPlacing(const UniformQuintic& full) : h_(full.knots().spacing()) {
    const int n = full.knots().spans;
    const bool closed = full.knots().closed;
    constexpr double kLower = 0.25, kUpper = 0.75;  // places inside a span, whose fourth derivative is straight
    std::vector<Vec2> fifth;
    fifth.reserve(n);
    for (int j = 0; j < n; ++j) fifth.push_back(full.at((j + kUpper) * h_, 4)[4] - full.at((j + kLower) * h_, 4)[4]);
    // The fifth derivative is constant in a span; its jumps at the knots stand for the sixth.
    const auto jump = [&](int j) {
      if (closed) j = ((j % n) + n) % n;
      if (!closed) j = std::clamp(j, 1, std::max(1, n - 1));
      return n > 1 ? (fifth[j] - fifth[(j + n - 1) % n]).norm() : 0.0;
    };
    std::vector<double> density;
    double mean = 0.0;
    for (int j = 0; j < n; ++j) {
      double sum = 0.0;
      for (int k = -1; k <= 2; ++k) sum += jump(j + k);
      density.push_back(std::pow(0.25 * sum, 1.0 / 6.0));
      mean += density.back() / n;
    }
    cumulative_.assign(1, 0.0);
    for (const double d : density)
      cumulative_.push_back(cumulative_.back() + std::max(d, kMonitorFloor * mean) + 1e-300);
  }

  double at(double share) const {
    const double wanted = share * cumulative_.back();
    const auto next = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, wanted);
    const double low = *(next - 1), high = *next;
    const auto span = static_cast<double>(next - cumulative_.begin() - 1);
    return h_ * (span + std::clamp((wanted - low) / (high - low), 0.0, 1.0));
  }

 private:
  double h_;
  std::vector<double> cumulative_;
};

class KnotRemoval {
 public:
  KnotRemoval(const UniformQuintic& full, const FewestKnotsLimits& limits, CancelCheck check)
      : full_(full), limits_(limits), check_(check), placing_(full), closed_(full.knots().closed) {
    const UniformKnots& knots = full.knots();
    const int count = limits.perSpan * knots.spans + (closed_ ? 0 : 1);
    std::vector<double> kappas;
    for (int j = 0; j < count; ++j) {
      const double u = j * knots.length / (limits.perSpan * knots.spans);
      const PlaneDerivatives d = full.at(u, 2);
      const double share = u / knots.length;
      Station& station = stations_.emplace_back();
      station.u = u;
      station.target = d[0] + (1.0 - share) * limits.startShift + share * limits.endShift;
      station.normal = leftNormal(d[1]).normalized();
      station.kappa = kappaOf(d[1], d[2]);
      station.bend = d[2];
      kappas.push_back(station.kappa);
    }
    Vec2 low = stations_.front().target, high = low;
    for (const Station& station : stations_) {
      low = low.cwiseMin(station.target);
      high = high.cwiseMax(station.target);
    }
    least_ = kWrongWayKept / std::max((high - low).norm(), 1e-12);
    const std::vector<ExtremumIndex> extrema = extremumIndices(kappas, least_, SequenceStart::AtEnd);
    extrema_ = static_cast<int>(extrema.size());
    if (!limits.stations.empty())
      nearest_ = std::ranges::min(limits.stations, {}, &FewestKnotsLimit::distancePx).distancePx;
    findDirections(extrema);
  }

  std::optional<FewestKnotsResult> run() {
    const int n = full_.knots().spans;
    const int most = static_cast<int>(kLeastGain * n);
    int low = closed_ ? kFewestClosed : 1, high = most;  // what is still to be tried
    if (high < low || limits_.stations.size() != stations_.size()) return std::nullopt;
    std::optional<FewestKnotsResult> best;
    int spans = std::clamp(static_cast<int>(kFirstGuess * n), low, high);
    for (int trial = 0; trial < kTrials && low <= high; ++trial) {
      if (best && high - low < kCloseEnough * high) break;
      const Fit fit = tried(spans);
      if (check_.isCancelled()) return std::nullopt;
      // The error of the curvature goes with the fourth power of the length of the spans.
      const double wanted = spans * std::pow(std::clamp(fit.excess, kLeastExcess, kNoFit), 0.25);
      if (fit.excess <= 1.0) {
        best = made(fit, spans);
        high = spans - 1;
        spans = std::clamp(static_cast<int>(std::ceil(wanted)), low, std::max(low, high));
      } else {
        low = spans + 1;
        spans = std::clamp(static_cast<int>(std::ceil(wanted)), low, std::max(low, high));
      }
    }
    return best;
  }

 private:
  /// The full curve at one of the check stations.
  struct Station {
    double u = 0.0;
    Vec2 target = Vec2::Zero();  ///< Its place, with the shifts of the ends.
    Vec2 normal = Vec2::UnitY();
    Vec2 bend = Vec2::Zero();  ///< Second derivative.
    double kappa = 0.0;
    int direction = 0;  ///< Whether its curvature rises (1) or falls (-1); 0 next to extrema.
  };

  /// Knots of a curve of `spans` spans: clamped, or running on periodically.
  std::vector<double> knotsFor(int spans) const {
    const double length = full_.knots().length;
    std::vector<double> inner;
    for (int i = 0; i <= spans; ++i)
      inner.push_back(i == spans ? length : i == 0 ? 0.0 : placing_.at(double(i) / spans));
    std::vector<double> knots;
    for (int i = -5; i <= spans + 5; ++i) {
      if (!closed_) {
        knots.push_back(inner[std::clamp(i, 0, spans)]);
      } else {
        const int lap = i < 0 ? -1 : i >= spans ? 1 : 0;
        knots.push_back(inner[i - lap * spans] + lap * length);
      }
    }
    return knots;
  }

  static BandRow rowOf(const BasisRow& basis, std::size_t order) {
    BandRow row;
    row.first = basis.first;
    for (std::size_t i = 0; i < 6; ++i) row.v[i] = basis.values[order][i];
    return row;
  }

  struct Fit {
    Eigen::VectorXd x, y;
    double moved = 0.0;
    double excess = kNoFit;     ///< Largest deviation in units of its limit; more than 1 when extrema come or go.
    bool keepsExtrema = false;  ///< As many as the full curve.
  };

  /// Least squares on `spans` spans, of places and second derivatives, each in units of its limit.
  Fit tried(int spans) const {
    const std::vector<double> knots = knotsFor(spans);
    const int points = spans + 5, unknowns = closed_ ? spans : points;
    BandedMatrix normal(unknowns, BandRow::kHalfWidth, closed_);
    Fit fit;
    fit.x = fit.y = Eigen::VectorXd::Zero(unknowns);
    std::vector<BasisRow> rows;
    rows.reserve(stations_.size());
    const auto add = [&](const BandRow& row, double weight, const Vec2& target) {
      normal.addOuter(row, weight);
      addTo(fit.x, row, weight * target.x());
      addTo(fit.y, row, weight * target.y());
    };
    for (int i = 0; i < std::ssize(stations_); ++i) {
      if (check_.isCancelled()) return fit;
      rows.push_back(basis(5, knots, points, stations_[i].u, 2));
      const double place = nearest_ / limits_.stations[i].distancePx;
      add(rowOf(rows.back(), 0), isEnd(i) ? kHoldWeight : place * place, stations_[i].target);
      const double share = nearest_ / std::max(kappaLimit(i), 1e-12);
      add(rowOf(rows.back(), 2), share * share, stations_[i].bend);
    }
    BandedCholesky cholesky;
    if (!cholesky.factor(normal)) return fit;
    cholesky.solveInPlace(fit.x);
    cholesky.solveInPlace(fit.y);
    if (!fit.x.allFinite() || !fit.y.allFinite()) return fit;
    measure(fit, rows);
    if (!fit.keepsExtrema && fit.excess <= kStraightenBelow) {
      Fit monotone = fit;
      if (makeMonotone(monotone, knots)) measure(monotone, rows);
      if (monotone.keepsExtrema) fit = std::move(monotone);
    }
    if (!fit.keepsExtrema) fit.excess = std::max(fit.excess, kExtremaExcess);
    return fit;
  }

  /// Takes out the ripple that the fit has made: of all curves in the frame of this one that rise and fall where the
  /// full one does, the one that is nearest in place and curvature.
  bool makeMonotone(Fit& fit, const std::vector<double>& knots) const {
    const int points = static_cast<int>(knots.size()) - 6, unknowns = static_cast<int>(fit.x.size());
    BandedProgram qp{BandedMatrix(unknowns, BandRow::kHalfWidth, closed_), Eigen::VectorXd::Zero(unknowns), {}, {}};
    struct Place {
      PlaneDerivatives d;
      BandRow row;
    };
    std::vector<Place> places;
    const auto add = [&](const BandRow& row, double w, double target) {
      qp.a.addOuter(row, w);
      addTo(qp.b, row, w * target);
    };
    for (int i = 0; i < std::ssize(stations_); ++i) {
      if (check_.isCancelled()) return false;
      const Station& full = stations_[i];
      const BasisRow basisRow = basis(5, knots, points, full.u, 4);
      std::array<BandRow, 5> rows;
      PlaneDerivatives d;
      for (std::size_t order = 0; order < 5; ++order) {
        rows[order] = rowOf(basisRow, order);
        d[order] = Vec2(dot(rows[order], fit.x), dot(rows[order], fit.y));
      }
      const FrameStation station = frameStation(d, rows);
      const Vec2 normal = leftNormal(d[1]).normalized();
      const double distance = limits_.stations[i].distancePx, weight = 1.0 / (distance * distance);
      add(rows[0], isEnd(i) ? kEndHold * weight : weight, (full.target - d[0]).dot(normal));
      const double limit = std::max(kappaLimit(i), 1e-12);
      add(station.kappaRow, 1.0 / (limit * limit), full.kappa - station.kappa);
      places.push_back({d, rows[0]});
      if (full.direction == 0) continue;
      BandRow row = station.slopeRow;
      for (double& v : row.v) v *= full.direction;
      qp.rows.push_back(row);
      qp.bounds.push_back(-full.direction * station.slope);
    }
    const InteriorPointResult solved = solveProgram(qp, {}, check_);
    if (check_.isCancelled() || solved.why == Termination::Degenerate || !solved.x.allFinite()) return false;
    BandedMatrix normal(unknowns, BandRow::kHalfWidth, closed_);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns), y = x;
    for (int i = 0; i < std::ssize(places); ++i) {
      const auto& [d, row] = places[i];
      const double w = isEnd(i) ? kHoldWeight : 1.0;
      const Vec2 p = isEnd(i) ? stations_[i].target : Vec2(d[0] + dot(row, solved.x) * leftNormal(d[1]).normalized());
      normal.addOuter(row, w);
      addTo(x, row, w * p.x());
      addTo(y, row, w * p.y());
    }
    BandedCholesky cholesky;
    if (!cholesky.factor(normal)) return false;
    cholesky.solveInPlace(x);
    cholesky.solveInPlace(y);
    if (!x.allFinite() || !y.allFinite()) return false;
    fit.x = std::move(x);
    fit.y = std::move(y);
    return true;
  }

  /// Sets the directions of the stations.
  void findDirections(const std::vector<ExtremumIndex>& extrema) {
    const int count = static_cast<int>(stations_.size());
    const auto stretch = [&](int from, int to, bool isFirst, bool isLast) {
      const double a = stations_[from].kappa, b = stations_[to].kappa;
      const int low = isFirst ? from : from + kFreeSpans * limits_.perSpan;
      const int high = isLast ? to : to - kFreeSpans * limits_.perSpan;
      for (int i = low; i <= high; ++i) stations_[i].direction = b > a ? 1 : -1;
    };
    int from = 0;
    const int last = static_cast<int>(extrema.size());
    for (int k = 0; k <= last; ++k) {
      const int to = k < last ? extrema[k].index : count - 1;
      // Where a closed curve begins there may be an extremum as well: its first and last stretch are left alone.
      if (!closed_ || (k > 0 && k < last)) stretch(from, to, k == 0, k == last);
      from = to;
    }
  }

  double kappaLimit(int i) const { return limits_.kappaShare * limits_.stations[i].kappaSigma; }
  bool isEnd(int i) const { return !closed_ && (i == 0 || i + 1 == std::ssize(stations_)); }

  void measure(Fit& fit, const std::vector<BasisRow>& rows) const {
    fit.moved = 0.0;
    std::vector<double> kappa;
    double excess = 0.0;
    for (int i = 0; i < std::ssize(rows); ++i) {
      const Station& full = stations_[i];
      std::array<Vec2, 3> d;
      for (std::size_t order = 0; order < 3; ++order) {
        const BandRow row = rowOf(rows[i], order);
        d[order] = Vec2(dot(row, fit.x), dot(row, fit.y));
      }
      kappa.push_back(kappaOf(d[1], d[2]));
      const double moved = std::abs((d[0] - full.target).dot(full.normal));
      fit.moved = std::max(fit.moved, moved);
      excess = std::max(excess, moved / limits_.stations[i].distancePx);
      excess = std::max(excess, std::abs(kappa.back() - full.kappa) / std::max(kappaLimit(i), 1e-300));
    }
    fit.excess = excess;
    fit.keepsExtrema = countExtrema(kappa, least_, false) == extrema_;
  }

  std::optional<FewestKnotsResult> made(const Fit& fit, int spans) const {
    const std::vector<double> knots = knotsFor(spans);
    std::vector<Vec2> controls;
    const auto count = static_cast<Eigen::Index>(knots.size()) - 6;
    for (Eigen::Index i = 0; i < count; ++i) controls.emplace_back(fit.x[i % fit.x.size()], fit.y[i % fit.y.size()]);
    if (!closed_) {
      controls.front() = stations_.front().target;
      controls.back() = stations_.back().target;
    }
    auto curve = NurbsCurve::make(5, knots, std::move(controls));
    if (curve && closed_) curve = clamped(*curve);
    if (!curve) return std::nullopt;
    return FewestKnotsResult{std::move(*curve), fit.moved};
  }

  const UniformQuintic& full_;
  const FewestKnotsLimits& limits_;
  CancelCheck check_;
  KnotPlacing placing_;
  bool closed_;
  std::vector<Station> stations_;
  double least_ = 0.0, nearest_ = 1.0;
  int extrema_ = 0;
};

}  // namespace

std::optional<FewestKnotsResult> withFewestKnots(const UniformQuintic& full, const FewestKnotsLimits& limits,
                                                 CancelCheck check) {
  const auto isPositive = [](const FewestKnotsLimit& limit) { return limit.distancePx > 0.0; };
  if (!std::ranges::all_of(limits.stations, isPositive)) return std::nullopt;
  return KnotRemoval(full, limits, check).run();
}

}  // namespace batten
