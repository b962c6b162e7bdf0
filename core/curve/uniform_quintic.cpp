// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/uniform_quintic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/curve/blossom.h"
#include "core/curve/foot_step.h"
#include "core/solve/banded_cholesky.h"

namespace batten {
namespace {

/// Powers of t (columns) in the six pieces of the uniform quintic B-spline (rows), times 120.
constexpr double kPieces[6][6] = {{1, -5, 10, -10, 5, -1},    {26, -50, 20, 20, -20, 5}, {66, 0, -60, 0, 30, -10},
                                  {26, 50, 20, -20, -20, 10}, {1, 5, 10, 10, 5, -5},     {0, 0, 0, 0, 0, 1}};

/// Factor of t^(power - order) when t^power is derived `order` times.
constexpr double fallingFactor(int power, int order) {
  double f = 1.0;
  for (int i = 0; i < order; ++i) f *= power - i;
  return f;
}

using PieceLanes = std::array<double, 6>;

/// The pieces derived 0..4 times: by the powers left, the coefficients of all six.
constexpr auto kDerived = [] {
  std::array<std::array<PieceLanes, 6>, 5> table{};
  for (int order = 0; order < 5; ++order) {
    for (std::size_t j = 0; j < 6; ++j) {
      for (int power = order; power < 6; ++power) {
        table[order][power - order][j] = fallingFactor(power, order) * kPieces[j][power];
      }
    }
  }
  return table;
}();

/// The polynomials that are 1 at one node of the rule of a span and 0 at the others.
constexpr auto kSpeedPowers = lagrangePolynomials(kSpanRule.node);

/// The six pieces at t, derived so often, times `scale`: side by side.
template <int kOrder>
PieceLanes pieceValues(double t, double scale) {
  PieceLanes values = kDerived[kOrder][5 - kOrder];
  for (int power = 4 - kOrder; power >= 0; --power) {
    for (std::size_t j = 0; j < 6; ++j) values[j] = kDerived[kOrder][power][j] + t * values[j];
  }
  for (double& value : values) value *= scale;
  return values;
}

constexpr double kPieceScale = 1.0 / 120.0;  // of kPieces

}  // namespace

UniformKnots::Place UniformKnots::placeOf(double u) const {
  double place = u * spans / length;
  if (closed && !(place >= 0.0 && place < spans)) place -= spans * std::floor(place / spans);
  const int j = place > 0.0 ? std::min(static_cast<int>(std::min(place, 1e9)), spans - 1) : 0;
  return {j, place - j};
}

BandRow UniformKnots::row(double u, int order) const {
  const Place place = placeOf(u);
  const double step = spacing();
  double scale = kPieceScale;
  for (int i = 0; i < order; ++i) scale /= step;
  switch (order) {
    case 0:
      return {place.span, pieceValues<0>(place.at, scale)};
    case 1:
      return {place.span, pieceValues<1>(place.at, scale)};
    case 2:
      return {place.span, pieceValues<2>(place.at, scale)};
    case 3:
      return {place.span, pieceValues<3>(place.at, scale)};
    default:
      return {place.span, pieceValues<4>(place.at, scale)};
  }
}

std::array<BandRow, 2> UniformKnots::firstRows(double u) const {
  const auto [span, t] = placeOf(u);
  return {BandRow{span, pieceValues<0>(t, kPieceScale)}, BandRow{span, pieceValues<1>(t, kPieceScale / spacing())}};
}

std::array<BandRow, 5> UniformKnots::rows(double u, bool bendOnly) const {
  const auto [span, t] = placeOf(u);
  const double step = spacing();
  const double first = kPieceScale / step, second = first / step, third = second / step, fourth = third / step;
  std::array<BandRow, 5> rows{BandRow{span, pieceValues<0>(t, kPieceScale)}, BandRow{span, pieceValues<1>(t, first)},
                              BandRow{span, pieceValues<2>(t, second)}, BandRow{span, {}},
                              BandRow{span, pieceValues<4>(t, fourth)}};
  if (!bendOnly) rows[3].v = pieceValues<3>(t, third);
  return rows;
}

UniformQuintic::UniformQuintic(const UniformKnots& knots, std::vector<Vec2> coefficients)
    : knots_(knots), coefficients_(std::move(coefficients)) {
  perUnit_ = knots_.spans / knots_.length;
  const std::size_t count = knots_.coefficients();
  polynomials_.resize(knots_.spans);
  for (std::size_t j = 0; j < polynomials_.size(); ++j) {
    for (std::size_t power = 0; power < 6; ++power) {
      Vec2 sum = Vec2::Zero();
      for (std::size_t i = 0; i < 6; ++i) sum += kPieces[i][power] * coefficients_[(j + i) % count];
      polynomials_[j][power] = sum / 120.0;
    }
  }
  spanLengths_.assign(1, 0.0);
  const double h = knots_.spacing();
  for (const auto& p : polynomials_) {
    std::array<double, 4> speed{};
    double sum = 0.0;
    for (std::size_t g = 0; g < 4; ++g) {
      const double u = kSpanRule.node[g];
      const Vec2 d = p[1] + u * (2 * p[2] + u * (3 * p[3] + u * (4 * p[4] + u * (5 * p[5]))));
      const double v = d.norm() / h;
      sum += kSpanRule.weight[g] * v;
      for (std::size_t k = 0; k < 4; ++k) speed[k] += v * kSpeedPowers[g][k];
    }
    speeds_.push_back(speed);
    spanLengths_.push_back(spanLengths_.back() + sum * h);
  }
}

PlaneDerivatives UniformQuintic::at(double u, int order) const {
  const double f = perUnit_;
  int span = 0;
  const double place = u * f;
  if (place >= 0.0 && place < knots_.spans) {  // the usual case, without a division
    span = static_cast<int>(place);
    u = place - span;
  } else {
    const UniformKnots::Place wrapped = knots_.placeOf(u);
    span = wrapped.span;
    u = wrapped.at;
  }
  const auto& p = polynomials_[span];
  PlaneDerivatives d{};
  d[0] = p[0] + u * (p[1] + u * (p[2] + u * (p[3] + u * (p[4] + u * p[5]))));
  if (order >= 1) d[1] = f * (p[1] + u * (2 * p[2] + u * (3 * p[3] + u * (4 * p[4] + u * (5 * p[5])))));
  if (order >= 2) d[2] = f * f * (2 * p[2] + u * (6 * p[3] + u * (12 * p[4] + u * (20 * p[5]))));
  if (order >= 3) d[3] = f * f * f * (6 * p[3] + u * (24 * p[4] + u * (60 * p[5])));
  if (order >= 4) d[4] = f * f * f * f * (24 * p[4] + u * (120 * p[5]));
  return d;
}

double UniformQuintic::arcLength(double u) const {
  const double h = knots_.spacing();
  const int last = knots_.spans - 1;
  const bool isPastSeam = knots_.closed && u >= knots_.length;
  const auto [j, place] = isPastSeam ? UniformKnots::Place{last, u / h - last} : knots_.placeOf(u);
  if (place < 0.0 || place > 1.0) {  // the end polynomial runs on: the cubic would not
    double sum = 0.0;
    for (std::size_t g = 0; g < 4; ++g)
      sum += kSpanRule.weight[g] * at((j + kSpanRule.node[g] * place) * h, 1)[1].norm();
    return spanLengths_[j] + sum * place * h;
  }
  const auto& v = speeds_[j];
  return spanLengths_[j] + h * place * (v[0] + place * (v[1] / 2.0 + place * (v[2] / 3.0 + place * (v[3] / 4.0))));
}

double UniformQuintic::footPoint(const Vec2& p, double start, double beyond) const {
  const double h = knots_.spacing();
  const double low = -beyond, high = knots_.length + beyond;
  double t = knots_.closed ? start : std::clamp(start, low, high);
  for (int round = 0; round < 12; ++round) {
    const PlaneDerivatives d = at(t, 2);
    double next = t + std::clamp(footStep(d[0] - p, d[1], d[2]), -h, h);
    if (!knots_.closed) next = std::clamp(next, low, high);
    const double move = std::abs(next - t);
    t = next;
    if (move < 1e-3 * h) break;  // Newton: what is left is about the square
  }
  return t;
}

Result<NurbsCurve> UniformQuintic::toNurbs(const Vec2& startShift, const Vec2& endShift) const {
  const int m = knots_.spans, count = knots_.coefficients();
  std::vector<int> places(6, 0);  // clamped knots in units of the spacing
  for (int j = 1; j < m; ++j) places.push_back(j);
  places.insert(places.end(), 6, m);
  std::vector<Vec2> points;
  for (int i = 0; i < m + 5; ++i) {
    // Blossom of the polynomial of a span under this control point at its five inner knots.
    const int j = std::clamp(i - 2, 0, m - 1);
    std::array<double, 5> arguments;
    for (int r = 1; r <= 5; ++r) arguments[r - 1] = places[i + r] - j;
    const auto knot = [](int k) { return static_cast<double>(k - 5); };
    const Vec2 point = blossom(
        5, knot, [&](int k) { return coefficients_[(j + k) % count]; }, 5, arguments.data());
    double greville = 0.0;
    for (int r = 1; r <= 5; ++r) greville += places[i + r] / (5.0 * m);
    points.push_back(point + (1.0 - greville) * startShift + greville * endShift);
  }
  std::vector<double> clampedKnots;
  clampedKnots.reserve(places.size());
  for (const int place : places) clampedKnots.push_back(place == m ? knots_.length : place * knots_.spacing());
  return NurbsCurve::make(5, std::move(clampedKnots), std::move(points));
}

std::optional<UniformQuintic> fitUniformQuintic(const UniformKnots& knots, std::span<const double> parameters,
                                                std::span<const Vec2> points, std::span<const double> weights,
                                                double lambda) {
  const int n = knots.coefficients();
  BandedMatrix normal(n, BandRow::kHalfWidth, knots.closed);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), y = Eigen::VectorXd::Zero(n);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    if (!(w > 0.0)) continue;
    const BandRow row = knots.row(parameters[i], 0);
    normal.addOuter(row, w);
    addTo(x, row, w * points[i].x());
    addTo(y, row, w * points[i].y());
  }
  if (lambda > 0.0) {
    const double h = knots.spacing();
    for (int j = 0; j < knots.spans; ++j) {  // |P'''|^2 is of degree 4: exact
      for (std::size_t g = 0; g < 4; ++g) {
        normal.addOuter(knots.row((j + kSpanRule.node[g]) * h, 3), lambda * h * kSpanRule.weight[g]);
      }
    }
  }
  BandedCholesky cholesky;
  if (!cholesky.factor(normal)) return std::nullopt;
  cholesky.solveInPlace(x);
  cholesky.solveInPlace(y);
  if (!x.allFinite() || !y.allFinite()) return std::nullopt;
  std::vector<Vec2> coefficients;
  coefficients.reserve(n);
  for (int i = 0; i < n; ++i) coefficients.emplace_back(x[i], y[i]);
  return UniformQuintic(knots, std::move(coefficients));
}

}  // namespace batten
