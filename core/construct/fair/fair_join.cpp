// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_join.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/construct/fair/fair_frame.h"
#include "core/curve/knot_operations.h"
#include "core/curve/uniform_quintic.h"
#include "core/solve/banded_cholesky.h"
#include "core/solve/banded_matrix.h"

namespace batten {
namespace {

constexpr double kKnotPx = 3.0;                                 // at least, from knot to knot …
constexpr double kKnotShare = 0.25;                             // … and of the cut-off: what is finer is not seen
constexpr double kCutoffsPx[] = {30.0, 22.0, 16.0, 12.0, 9.0};  // smoothest first
constexpr double kAwayPx = 0.7;       // a smoother curve that leaves the points by more is not taken
constexpr double kLoopAwayPx = 0.35;  // small loops would shrink
constexpr double kHold = 1e8;         // weight of what is set exactly afterwards

double knotSpacing(double cutoffPx) { return std::max(kKnotPx, kKnotShare * cutoffPx); }

/// The first three control points of a clamped quintic from its derivatives at the start; `u` are its first knots.
std::array<Vec2, 3> controlsOf(const CurveEnd& end, double u6, double u7) {
  std::array<Vec2, 3> p;
  p[0] = end[0];
  p[1] = p[0] + end[1] * (u6 / 5.0);
  p[2] = p[1] + (end[1] + end[2] * (u6 / 4.0)) * (u7 / 5.0);
  return p;
}

BandRow bandRow(std::span<const double> knots, int count, double u, int order) {
  const BasisRow row = basis(5, knots, count, u, order);
  BandRow out;
  out.first = row.first;
  for (std::size_t i = 0; i < 6; ++i) out.v[i] = row.values[order][i];
  return out;
}

struct Fixed {
  int index;
  Vec2 point;
};

std::vector<Fixed> fixedControls(const std::vector<Vec2>& p, const std::vector<double>& knots, int count,
                                 const std::optional<CurveEnd>& before, const std::optional<CurveEnd>& after) {
  std::vector<Fixed> fixed;
  const auto n = knots.size();
  const double length = knots.back();
  if (before) {
    const auto c = controlsOf(*before, knots[6], knots[7]);
    for (int i = 0; i < 3; ++i) fixed.push_back({i, c[i]});
  } else {
    fixed.push_back({0, p.front()});
  }
  if (after) {
    const CurveEnd reversed{(*after)[0], -(*after)[1], (*after)[2]};
    const auto c = controlsOf(reversed, length - knots[n - 7], length - knots[n - 8]);
    for (int i = 0; i < 3; ++i) fixed.push_back({count - 1 - i, c[i]});
  } else {
    fixed.push_back({count - 1, p.back()});
  }
  return fixed;
}

/// Least squares for the control points of a clamped quintic through points at given parameters; px.
class TightProblem {
 public:
  TightProblem(const std::vector<Vec2>& points, const std::vector<double>& t, const std::vector<double>& knots,
               int count, const std::vector<Fixed>& fixed)
      : points_(points),
        fixed_(fixed),
        count_(count),
        data_(count, BandRow::kHalfWidth, false),
        bend_(count, BandRow::kHalfWidth, false) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      rows_.push_back(bandRow(knots, count, t[i], 0));
      data_.addOuter(rows_.back(), 1.0);
    }
    const int spans = count - 5;
    const double h = knots.back() / spans;
    for (int j = 0; j < spans; ++j) {
      for (std::size_t g = 0; g < 4; ++g) {
        bend_.addOuter(bandRow(knots, count, (j + kSpanRule.node[g]) * h, 3), h * kSpanRule.weight[g]);
      }
    }
  }

  std::optional<std::vector<Vec2>> solve(double lambda) const {
    BandedMatrix a = data_;
    a.add(bend_, lambda);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(count_), y = Eigen::VectorXd::Zero(count_);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      addTo(x, rows_[i], points_[i].x());
      addTo(y, rows_[i], points_[i].y());
    }
    const double hold = kHold * (1.0 + lambda);
    for (const Fixed& f : fixed_) {
      a.entry(f.index, 0) += hold;
      x[f.index] += hold * f.point.x();
      y[f.index] += hold * f.point.y();
    }
    BandedCholesky cholesky;
    if (!cholesky.factor(a)) return std::nullopt;
    cholesky.solveInPlace(x);
    cholesky.solveInPlace(y);
    if (!x.allFinite() || !y.allFinite()) return std::nullopt;
    std::vector<Vec2> controls;
    controls.reserve(count_);
    for (int i = 0; i < count_; ++i) controls.emplace_back(x[i], y[i]);
    for (const Fixed& f : fixed_) controls[f.index] = f.point;
    return controls;
  }

  /// Number of points that the curve leaves by more than it may.
  int pointsAway(const std::vector<Vec2>& controls) const {
    int away = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      Vec2 q = Vec2::Zero();
      for (std::size_t k = 0; k < 6; ++k) q += rows_[i].v[k] * controls[rows_[i].first + k];
      away += (q - points_[i]).norm() > kAwayPx ? 1 : 0;
    }
    return away;
  }

 private:
  const std::vector<Vec2>& points_;
  const std::vector<Fixed>& fixed_;
  int count_;
  BandedMatrix data_, bend_;
  std::vector<BandRow> rows_;
};

}  // namespace

CurveEnd startOf(const NurbsCurve& curve) {
  const auto d = curve.derivatives(curve.start(), 2);
  return {d[0], d[1], d[2]};
}

CurveEnd endOf(const NurbsCurve& curve) {
  const auto d = curve.derivatives(curve.end(), 2);
  return {d[0], d[1], d[2]};
}

Result<NurbsCurve> cornerFill(std::span<const Vec2> points, const std::optional<CurveEnd>& before,
                              const std::optional<CurveEnd>& after) {
  // About the first point: the numbers of the system stay near 1.
  const Vec2 origin = before ? (*before)[0] : points.empty() ? (*after)[0] : points.front();
  std::optional<CurveEnd> first = before, last = after;
  if (first) (*first)[0] -= origin;
  if (last) (*last)[0] -= origin;
  std::vector<Vec2> p;
  if (first) p.push_back((*first)[0]);
  for (const Vec2& q : points) p.push_back(q - origin);
  if (last) p.push_back((*last)[0]);
  std::vector<double> t(1, 0.0);
  for (std::size_t i = 1; i < p.size(); ++i) t.push_back(t.back() + (p[i] - p[i - 1]).norm());
  const double length = t.back();
  if (!(length > 0.0) || !std::isfinite(length)) {
    return fail(ErrorCode::Numerical, "A line is too short for a curve; drop short lines.");
  }
  const double density = std::min(1.0, static_cast<double>(p.size()) / length);
  std::vector<Vec2> controls;
  std::vector<double> knots;
  for (const double cutoffPx : kCutoffsPx) {
    const int spans = std::max(1, static_cast<int>(std::lround(length * density / knotSpacing(cutoffPx))));
    std::vector<double> even(6, 0.0);
    for (int j = 1; j < spans; ++j) even.push_back(length * j / spans);
    even.insert(even.end(), 6, length);
    const std::vector<Fixed> fixed = fixedControls(p, even, spans + 5, first, last);
    const TightProblem problem(p, t, even, spans + 5, fixed);
    auto solved = problem.solve(cutoffPenalty(density, cutoffPx));
    if (!solved) continue;
    controls = std::move(*solved);
    knots = std::move(even);
    if (problem.pointsAway(controls) <= 1) break;
  }
  if (controls.empty()) return fail(ErrorCode::Numerical, "A sharp turn could not be rounded; mark its corner.");
  for (Vec2& c : controls) c += origin;
  if (!before) controls.front() = points.front();
  if (!after) controls.back() = points.back();
  return NurbsCurve::make(5, std::move(knots), std::move(controls));
}

Result<NurbsCurve> tightLoop(std::span<const Vec2> points) {
  std::vector<Vec2> p;
  for (const Vec2& q : points) p.push_back(q - points.front());
  std::vector<double> t(1, 0.0);
  for (std::size_t i = 1; i < p.size(); ++i) t.push_back(t.back() + (p[i] - p[i - 1]).norm());
  const double length = p.empty() ? 0.0 : t.back() + (p.front() - p.back()).norm();
  const auto nothing = [] { return fail(ErrorCode::Numerical, "A line is too short for a curve; drop short lines."); };
  if (!(length > 0.0) || !std::isfinite(length)) return nothing();
  const double density = std::min(1.0, static_cast<double>(p.size()) / length);
  std::optional<UniformQuintic> loop;
  for (const double cutoffPx : kCutoffsPx) {
    const UniformKnots knots = fairKnots(length, knotSpacing(cutoffPx) / density, true);
    auto fit = fitUniformQuintic(knots, t, p, {}, cutoffPenalty(density, cutoffPx));
    if (!fit) continue;
    loop = std::move(*fit);
    int away = 0;
    for (std::size_t i = 0; i < p.size(); ++i) away += (loop->at(t[i], 0)[0] - p[i]).norm() > kLoopAwayPx ? 1 : 0;
    if (away <= 1) break;
  }
  if (!loop) return nothing();
  auto curve = loop->toNurbs();
  if (!curve) return curve;
  return curve->mapped(Eigen::Matrix2d::Identity(), points.front());
}

Result<NurbsCurve> joinSmoothly(std::span<const NurbsCurve> parts) {
  std::vector<double> knots(6, 0.0);
  std::vector<Vec2> points;
  double end = 0.0;
  for (const NurbsCurve& part : parts) {
    const int joint = static_cast<int>(knots.size()) - 1;
    const double shift = end - part.start();
    for (auto k = part.knots().begin() + 6; k != part.knots().end(); ++k) knots.push_back(*k + shift);
    const auto own = part.controlPoints();
    if (points.empty()) {
      points.assign(own.begin(), own.end());
    } else {
      points.insert(points.end(), own.begin() + 1, own.end());
      knots.erase(knots.begin() + joint);
      removeExactKnot(5, knots, points, {joint - 1, 5});
      removeExactKnot(5, knots, points, {joint - 2, 4});
    }
    end = knots.back();
  }
  return NurbsCurve::make(5, std::move(knots), std::move(points));
}

}  // namespace batten
