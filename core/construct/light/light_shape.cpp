// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_shape.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/curve/knot_operations.h"
#include "core/solve/banded_cholesky.h"
#include "core/solve/banded_matrix.h"

namespace batten {
namespace {

constexpr double kMostStartLog = 2.0;     // of a start: the fit itself allows a little more
constexpr double kEvenShare = 0.15;       // of the mean density of breaks, put in everywhere
constexpr double kBreakWindow = 0.01;     // of the length, for the second derivative of the curvature
constexpr int kStartSamplesPerSpan = 24;  // of the reference, at the most
constexpr double kFifthRoot = 0.2;        // see breakDensity()

/// Density of breaks at the samples of the reference: fifth root of the second derivative of the curvature, smoothed.
std::vector<double> breakDensity(const LightReference& reference) {
  const int n = reference.size(), half = std::max(1, static_cast<int>(kBreakWindow * n));
  std::vector<double> density(n);
  double mean = 0.0;
  for (int i = 0; i < n; ++i) {
    int before = i - half, after = i + half;
    double length = 0.0;
    if (reference.isClosed()) {
      before = (before + n) % n;
      after %= n;
      length = reference.at(after).s - reference.at(before).s;
      if (length < 0.0) length += reference.length();
    } else {
      before = std::max(0, before);
      after = std::min(n - 1, after);
      length = reference.at(after).s - reference.at(before).s;
    }
    const double second = (reference.at(after).slope - reference.at(before).slope) / length;
    density[i] = std::pow(std::abs(second), kFifthRoot);
    mean += density[i] / n;
  }
  for (double& d : density) d += kEvenShare * mean + (mean > 0.0 ? 0.0 : 1.0);
  return density;
}

std::vector<double> logLengthsByShape(const LightReference& reference, int spans) {
  const std::vector<double> density = breakDensity(reference);
  const int n = reference.size();
  std::vector<double> cumulated{0.0};
  for (int i = 0; i < n; ++i) {
    const double next = i + 1 < n ? reference.at(i + 1).s : reference.length();
    cumulated.push_back(cumulated.back() + density[i] * (next - reference.at(i).s));
  }
  std::vector<double> logs;
  double last = 0.0;
  for (int k = 1; k <= spans; ++k) {
    const double wanted = cumulated.back() * k / spans;
    const auto above = std::lower_bound(cumulated.begin() + 1, cumulated.end() - 1, wanted);
    const auto i = static_cast<int>(above - cumulated.begin()) - 1;
    const double step = *above - *(above - 1);
    const double from = reference.at(i).s, to = i + 1 < n ? reference.at(i + 1).s : reference.length();
    const double s =
        k == spans ? reference.length() : from + (to - from) * (step > 0.0 ? (wanted - *(above - 1)) / step : 0.0);
    logs.push_back(
        std::clamp(std::log(std::max(1e-9, (s - last) / reference.length() * spans)), -kMostStartLog, kMostStartLog));
    last = s;
  }
  return logs;
}

using PointValues = Eigen::Array<double, static_cast<int>(kSpanPoints), 1>;

/// Values of a span's control points at a place of it, from its Bezier matrix.
PointValues valuesAt(int degree, const std::array<PointValues, kSpanPoints>& matrix, double at) {
  const PlaceTable::Place place = bernsteinPlace(degree, at);
  PointValues values = PointValues::Zero();
  for (int k = 0; k <= degree; ++k) values += place.rows[0][k] * matrix[k];
  return values;
}

constexpr int kMostDensePoints = 150;  // of long curves the band is kept, so that the cost grows with the length only

/// Normal equations of a start over its control points; the matrix is dense or a band.
struct Normal {
  Eigen::MatrixXd matrix;
  BandedMatrix band;
  Eigen::MatrixXd right;

  Normal(int count, int degree, bool closed) : right(Eigen::MatrixXd::Zero(count, 2)) {
    if (count > kMostDensePoints) {
      band = BandedMatrix(count, degree, closed);
    } else {
      matrix = Eigen::MatrixXd::Zero(count, count);
    }
  }
  bool isBanded() const { return band.size() > 0; }
  void add(int row, int column, double value) {
    if (!isBanded()) {
      matrix(row, column) += value;
      return;
    }
    const int after = column - row + (column < row && band.isCyclic() ? band.size() : 0);
    if (after >= 0 && after <= band.halfWidth()) band.entry(row, after) += value;
  }
};

Normal normalOf(const LightShape& shape, const LightReference& reference) {
  Normal normal(static_cast<int>(shape.points.size()), shape.degree, shape.closed);
  const std::vector<double> lengths = shape.lengths();
  double total = 0.0;
  for (const double l : lengths) total += l;
  double from = 0.0;
  std::array<PointValues, kSpanPoints> unit, matrix;
  for (std::size_t j = 0; j < kSpanPoints; ++j) {
    unit[j].setZero();
    unit[j][static_cast<Eigen::Index>(j)] = 1.0;
  }
  for (int span = 0; span < shape.spans(); ++span) {
    const double share = lengths[span] / total;
    bezierOfSpan(shape.degree, shape.knotsOf(span, lengths), unit, matrix);
    for (int k = 0; k < kStartSamplesPerSpan; ++k) {
      const double at = (k + 0.5) / kStartSamplesPerSpan;
      const Vec2 p = reference.pointAt((from + at * share) * reference.length());
      const PointValues values = valuesAt(shape.degree, matrix, at);
      for (int a = 0; a <= shape.degree; ++a) {
        const auto row = static_cast<int>(shape.pointOf(span, a));
        for (int b = 0; b <= shape.degree; ++b) {
          normal.add(row, static_cast<int>(shape.pointOf(span, b)), share * values[a] * values[b]);
        }
        normal.right.row(row) += share * values[a] * p.transpose();
      }
    }
    from += share;
  }
  return normal;
}

/// Solves for the control points first..first + count.
std::optional<Eigen::MatrixXd> solved(const Normal& normal, int first, int count, const Eigen::MatrixXd& right) {
  Eigen::MatrixXd result;
  if (normal.isBanded()) {
    BandedCholesky factor;
    const bool isAll = count == normal.band.size();
    if (!factor.factor(isAll ? normal.band : normal.band.block(first, count))) return std::nullopt;
    result.resize(count, 2);
    for (const Eigen::Index axis : {Eigen::Index{0}, Eigen::Index{1}})
      result.col(axis) = factor.solve(Eigen::VectorXd(right.col(axis)));
  } else {
    result = normal.matrix.block(first, first, count, count).ldlt().solve(right);
  }
  return result.allFinite() ? std::optional(std::move(result)) : std::nullopt;
}

/// What a control point at an end adds to the equations of those beside it, over all but the two ends.
Eigen::MatrixXd heldPart(const Normal& normal, bool isLast, const Vec2& at) {
  const Eigen::Index count = normal.right.rows(), inner = count - 2;
  if (!normal.isBanded()) return normal.matrix.block(1, isLast ? count - 1 : 0, inner, 1) * at.transpose();
  Eigen::VectorXd column = Eigen::VectorXd::Zero(count);
  for (int k = 1; k <= normal.band.halfWidth(); ++k) {
    const int last = normal.band.size() - 1;
    if (isLast) {
      column[last - k] = normal.band.entry(last - k, k);
    } else {
      column[k] = normal.band.entry(0, k);
    }
  }
  return column.segment(1, inner) * at.transpose();
}

}  // namespace

std::vector<double> LightShape::lengths() const {
  std::vector<double> result;
  result.reserve(logLengths.size());
  for (const double q : logLengths) result.push_back(std::exp(q));
  return result;
}

SpanKnots LightShape::knotsOf(int span, const std::vector<double>& lengths) const {
  SpanKnots knots{};
  const int n = spans();
  const auto lengthOf = [&](int i) {
    if (closed) return lengths[(i % n + n) % n];
    return i < 0 || i >= n ? 0.0 : lengths[i];
  };
  const int start = degree - 1;
  for (int k = 1; k < degree; ++k) knots[start - k] = knots[start - k + 1] - lengthOf(span - k);
  for (int k = 0; k < degree; ++k) knots[start + k + 1] = knots[start + k] + lengthOf(span + k);
  return knots;
}

std::array<Vec2, kSpanPoints> LightShape::pointsOf(int span) const {
  std::array<Vec2, kSpanPoints> result;
  result.fill(Vec2::Zero());
  for (int j = 0; j <= degree; ++j) result[j] = points[pointOf(span, j)];
  return result;
}

std::optional<NurbsCurve> LightShape::toNurbs(double length) const {
  const std::vector<double> steps = lengths();
  double total = 0.0;
  for (const double step : steps) total += step;
  const int n = spans();
  std::vector<double> breaks{0.0};
  for (int i = 0; i < n; ++i) breaks.push_back(breaks.back() + steps[i] / total * length);
  breaks.back() = length;
  std::vector<double> knots;
  std::vector<Vec2> all = points;
  if (closed) {
    for (int i = -degree; i <= n + degree; ++i) {
      const int laps = static_cast<int>(std::floor(static_cast<double>(i) / n));
      knots.push_back(breaks[i - laps * n] + laps * length);
    }
    for (int j = 0; j < degree; ++j) all.push_back(points[j % points.size()]);
  } else {
    knots.assign(degree, 0.0);
    knots.insert(knots.end(), breaks.begin(), breaks.end());
    knots.insert(knots.end(), degree, length);
  }
  auto curve = NurbsCurve::make(degree, std::move(knots), std::move(all));
  if (curve && closed) curve = clamped(*curve);
  return curve ? std::optional(std::move(*curve)) : std::nullopt;
}

std::optional<LightShape> startShape(const LightReference& reference, int degree, int spans, BreakStart breaks) {
  LightShape shape;
  shape.degree = degree;
  shape.closed = reference.isClosed();
  shape.logLengths =
      breaks == BreakStart::ByShape && spans > 1 ? logLengthsByShape(reference, spans) : std::vector<double>(spans);
  const int n = shape.closed ? spans : spans + degree;
  shape.points.assign(n, Vec2::Zero());
  const Normal normal = normalOf(shape, reference);
  if (shape.closed) {
    const auto points = solved(normal, 0, n, normal.right);
    if (!points) return std::nullopt;
    for (int i = 0; i < n; ++i) shape.points[i] = points->row(i).transpose();
    return shape;
  }
  shape.points.front() = reference.samples().front().point;
  shape.points.back() = reference.samples().back().point;
  if (n == 2) return shape;
  const Eigen::MatrixXd right = normal.right.middleRows(1, n - 2) - heldPart(normal, false, shape.points.front()) -
                                heldPart(normal, true, shape.points.back());
  const auto points = solved(normal, 1, n - 2, right);
  if (!points) return std::nullopt;
  for (int i = 1; i + 1 < n; ++i) shape.points[i] = points->row(i - 1).transpose();
  return shape;
}

}  // namespace batten
