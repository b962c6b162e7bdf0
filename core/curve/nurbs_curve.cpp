// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/nurbs_curve.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace batten {

namespace {

constexpr int kMaxOrder = 4;      // of derivatives that are asked for
constexpr int kAnyDegree = 0;     // stands for a degree that the compiler does not know
constexpr int kQuinticBasis = 5;  // nearly all curves

/// A parameter on a span of a knot vector.
struct PlaceOnKnots {
  int degree;
  const double* knots;
  int span;
  double u;
};

/// Values of the degree + 1 basis functions of a span, Piegl & Tiller A2.2. `values` holds 8 numbers. Tells
/// `difference` (row, column, knot difference) and `column` (number, its values) what the derivatives need. kDegree: of
/// the place, where the compiler knows it, so that all loops are unrolled; else kAnyDegree.
template <int kDegree, class Difference, class Column>
void basisTriangle(const PlaceOnKnots& place, double* values, const Difference& difference, const Column& column) {
  const int degree = kDegree == kAnyDegree ? place.degree : kDegree;
  const double* knots = place.knots;
  const int span = place.span;
  const double u = place.u;
  std::array<double, kMaxDegree + 1> left, right;
  values[0] = 1.0;
  column(0, values);
  for (int j = 1; j <= degree; ++j) {
    left[j] = u - knots[span + 1 - j];
    right[j] = knots[span + j] - u;
    double saved = 0.0;
    for (int r = 0; r < j; ++r) {
      const double leftR = left[j - r], whole = right[r + 1] + leftR;
      difference(j, r, whole);
      // Written so that the shares at both borders of a span are exactly 0 and 1: clamped curves start on their first
      // point.
      const double part = values[r] * (leftR / whole);
      values[r] = saved + (values[r] - part);
      saved = part;
    }
    values[j] = saved;
    column(j, values);
  }
}

void basisValues(int degree, const double* knots, int span, double u, double* values) {
  const auto run = [&](auto known) {
    basisTriangle<known()>(
        {degree, knots, span, u}, values, [](int, int, double) {}, [](int, const double*) {});
  };
  if (degree == kQuinticBasis) return run(std::integral_constant<int, kQuinticBasis>());
  run(std::integral_constant<int, kAnyDegree>());
}

/// Knot differences below the diagonal, values on it and above.
using BasisTriangle = double[kMaxDegree + 1][kMaxDegree + 1];

/// basisDerivatives() for a degree and an order that the compiler knows: derivative k of function r.
template <int kDegree, int kRow, int kStep>
void derivativeStep(const BasisTriangle& ndu, double (&a)[2][kMaxDegree + 1], BasisRow& row) {
  constexpr int kNow = (kStep + 1) % 2, kNext = kStep % 2, kBefore = kRow - kStep, kLower = kDegree - kStep;
  double d = 0.0;
  if constexpr (kRow >= kStep) {
    a[kNext][0] = a[kNow][0] / ndu[kLower + 1][kBefore];
    d = a[kNext][0] * ndu[kBefore][kLower];
  }
  constexpr int kFrom = kBefore >= -1 ? 1 : -kBefore, kTo = kRow - 1 <= kLower ? kStep - 1 : kDegree - kRow;
  for (int j = kFrom; j <= kTo; ++j) {
    a[kNext][j] = (a[kNow][j] - a[kNow][j - 1]) / ndu[kLower + 1][kBefore + j];
    d += a[kNext][j] * ndu[kBefore + j][kLower];
  }
  if constexpr (kRow <= kLower) {
    a[kNext][kStep] = -a[kNow][kStep - 1] / ndu[kLower + 1][kRow];
    d += a[kNext][kStep] * ndu[kRow][kLower];
  }
  row.values[kStep][kRow] = d;
}

template <int kDegree, int kOrder>
void knownDerivatives(const BasisTriangle& ndu, BasisRow& row) {
  const auto function = [&]<int kRow, int... kSteps>(std::integral_constant<int, kRow>,
                                                     std::integer_sequence<int, kSteps...>) {
    double a[2][kMaxDegree + 1];
    a[0][0] = 1.0;
    (derivativeStep<kDegree, kRow, kSteps + 1>(ndu, a, row), ...);
  };
  [&]<int... kRows>(std::integer_sequence<int, kRows...>) {
    (function(std::integral_constant<int, kRows>(), std::make_integer_sequence<int, kOrder>()), ...);
  }
  (std::make_integer_sequence<int, kDegree + 1>());
  double factor = kDegree;
  for (int k = 1; k <= kOrder; ++k) {
    for (int j = 0; j <= kDegree; ++j) row.values[k][j] *= factor;
    factor *= kDegree - k;
  }
}

/// Derivatives of the basis functions from the triangle of knot differences and values, Piegl & Tiller A2.3.
void basisDerivatives(int degree, const BasisTriangle& ndu, int order, BasisRow& row) {
  for (int r = 0; r <= degree; ++r) {
    double a[2][kMaxDegree + 1] = {};
    int now = 0, next = 1;
    a[0][0] = 1.0;
    for (int k = 1; k <= order; ++k) {
      double d = 0.0;
      const int rk = r - k, pk = degree - k;
      if (r >= k) {
        a[next][0] = a[now][0] / ndu[pk + 1][rk];
        d = a[next][0] * ndu[rk][pk];
      }
      const int from = rk >= -1 ? 1 : -rk;
      const int to = r - 1 <= pk ? k - 1 : degree - r;
      for (int j = from; j <= to; ++j) {
        a[next][j] = (a[now][j] - a[now][j - 1]) / ndu[pk + 1][rk + j];
        d += a[next][j] * ndu[rk + j][pk];
      }
      if (r <= pk) {
        a[next][k] = -a[now][k - 1] / ndu[pk + 1][r];
        d += a[next][k] * ndu[r][pk];
      }
      row.values[k][r] = d;
      std::swap(now, next);
    }
  }
  double factor = degree;
  for (int k = 1; k <= order; ++k) {
    for (int j = 0; j <= degree; ++j) row.values[k][j] *= factor;
    factor *= degree - k;
  }
}

}  // namespace

int spanOf(int degree, std::span<const double> knots, int controlPointCount, double u) {
  const auto first = knots.begin() + degree;
  const auto last = knots.begin() + controlPointCount;
  if (u >= *last) {
    // The end belongs to the span before it: the first knot that equals the end, minus one.
    return static_cast<int>(std::lower_bound(first, last, *last) - knots.begin()) - 1;
  }
  return static_cast<int>(std::upper_bound(first, last, std::max(u, *first)) - knots.begin()) - 1;
}

BasisRow basis(int degree, std::span<const double> knots, int controlPointCount, double u, int order) {
  BasisRow row;
  const int span = spanOf(degree, knots, controlPointCount, u);
  row.first = span - degree;
  std::array<double, kMaxDegree + 1>& values = row.values[0];
  if (order <= 0) {
    basisValues(degree, knots.data(), span, u, values.data());
    return row;
  }
  BasisTriangle ndu;
  const auto triangle = [&](auto known) {
    basisTriangle<known()>(
        {degree, knots.data(), span, u}, values.data(), [&](int j, int r, double whole) { ndu[j][r] = whole; },
        [&](int j, const double* column) {
          for (int r = 0; r <= j; ++r) ndu[r][j] = column[r];
        });
  };
  if (degree == kQuinticBasis && order <= 3) {
    triangle(std::integral_constant<int, kQuinticBasis>());
    if (order == 1) knownDerivatives<kQuinticBasis, 1>(ndu, row);
    if (order == 2) knownDerivatives<kQuinticBasis, 2>(ndu, row);
    if (order == 3) knownDerivatives<kQuinticBasis, 3>(ndu, row);
    return row;
  }
  triangle(std::integral_constant<int, kAnyDegree>());
  // Derivatives above the degree are zero, as the row already is.
  basisDerivatives(degree, ndu, std::min({order, degree, kMaxOrder}), row);
  return row;
}

struct NurbsCurve::Data {
  int degree = 1;
  std::vector<double> knots;
  std::vector<Vec2> controlPoints;
  std::vector<double> weights;
};

namespace {

std::optional<std::string> knotError(int degree, const std::vector<double>& knots, std::ptrdiff_t count) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) return "A knot is not a finite number.";
    if (i > 0 && knots[i] < knots[i - 1]) return "The knots decrease.";
    const std::size_t apart = degree + 1;
    if (i >= apart && knots[i] == knots[i - apart]) return "A knot is repeated more than degree + 1 times.";
  }
  const double length = knots[count] - knots[degree];
  if (!(length > 0.0) || !std::isfinite(length)) return "The curve has an empty domain.";
  return std::nullopt;
}

}  // namespace

Result<NurbsCurve> NurbsCurve::make(int degree, std::vector<double> knots, std::vector<Vec2> controlPoints,
                                    std::vector<double> weights) {
  const auto bad = [](std::string why) { return fail(ErrorCode::Numerical, "Not a valid curve: " + std::move(why)); };
  if (degree < 1 || degree > kMaxDegree) return bad("The degree is not within 1 to 7.");
  const auto count = std::ssize(controlPoints);
  if (count < degree + 1) return bad("There are fewer control points than degree + 1.");
  if (std::ssize(knots) != count + degree + 1) {
    return bad("The number of knots is not the number of control points + degree + 1.");
  }
  if (auto error = knotError(degree, knots, count)) return bad(*error);
  for (const Vec2& p : controlPoints) {
    if (!p.allFinite()) return bad("A control point is not finite.");
  }
  if (!weights.empty()) {
    if (std::ssize(weights) != count) return bad("The number of weights is not the number of control points.");
    for (const double w : weights) {
      if (!(w > 0.0) || !std::isfinite(w)) return bad("A weight is not a positive number.");
    }
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 1.0; })) weights.clear();
  }
  NurbsCurve curve;
  curve.data_ =
      std::make_shared<const Data>(Data{degree, std::move(knots), std::move(controlPoints), std::move(weights)});
  return curve;
}

int NurbsCurve::degree() const { return data_->degree; }
int NurbsCurve::controlPointCount() const { return static_cast<int>(data_->controlPoints.size()); }
std::span<const double> NurbsCurve::knots() const { return data_->knots; }
std::span<const Vec2> NurbsCurve::controlPoints() const { return data_->controlPoints; }
std::span<const double> NurbsCurve::weights() const { return data_->weights; }
bool NurbsCurve::isRational() const { return !data_->weights.empty(); }
double NurbsCurve::start() const { return data_->knots[data_->degree]; }
double NurbsCurve::end() const { return data_->knots[data_->controlPoints.size()]; }

Vec2 NurbsCurve::point(double u) const {
  const Data& d = *data_;
  const double clampedU = std::clamp(u, start(), end());
  const int span = spanOf(d.degree, d.knots, controlPointCount(), clampedU);
  std::array<double, kMaxDegree + 1> n;
  basisValues(d.degree, d.knots.data(), span, clampedU, n.data());
  const std::size_t first = span - d.degree;
  const std::size_t order = d.degree + 1;
  Vec2 sum = Vec2::Zero();
  if (d.weights.empty()) {
    for (std::size_t j = 0; j < order; ++j) sum += n[j] * d.controlPoints[first + j];
    return sum;
  }
  double weight = 0.0;
  for (std::size_t j = 0; j < order; ++j) {
    const double nw = n[j] * d.weights[first + j];
    sum += nw * d.controlPoints[first + j];
    weight += nw;
  }
  return sum / weight;
}

std::array<Vec2, 5> NurbsCurve::derivatives(double u, int order) const {
  const Data& d = *data_;
  const int top = std::clamp(order, 0, kMaxOrder);
  const BasisRow row = basis(d.degree, d.knots, controlPointCount(), std::clamp(u, start(), end()), top);
  const std::size_t first = row.first;
  const std::size_t terms = d.degree + 1;
  std::array<Vec2, 5> result;
  result.fill(Vec2::Zero());
  if (d.weights.empty()) {
    const Vec2* points = d.controlPoints.data() + first;
    for (int k = 0; k <= top; ++k) {
      for (std::size_t j = 0; j < terms; ++j) result[k] += row.values[k][j] * points[j];
    }
    return result;
  }
  std::array<double, 5> weight{};
  for (int k = 0; k <= top; ++k) {
    for (std::size_t j = 0; j < terms; ++j) {
      const double n = row.values[k][j] * d.weights[first + j];
      result[k] += n * d.controlPoints[first + j];
      weight[k] += n;
    }
  }
  // Quotient rule, A4.2: each order from the numerator's and the lower ones.
  constexpr double binomial[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};
  for (int k = 0; k <= top; ++k) {
    for (int i = 1; i <= k; ++i) result[k] -= binomial[k][i] * weight[i] * result[k - i];
    result[k] /= weight[0];
  }
  return result;
}

std::vector<double> NurbsCurve::breaks() const {
  const auto first = data_->knots.begin() + data_->degree;
  const auto last = data_->knots.begin() + controlPointCount() + 1;
  std::vector<double> result(first, last);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

NurbsCurve NurbsCurve::mapped(const Eigen::Matrix2d& linear, const Vec2& offset) const {
  Data d = *data_;
  for (Vec2& p : d.controlPoints) p = linear * p + offset;
  NurbsCurve curve;
  curve.data_ = std::make_shared<const Data>(std::move(d));
  return curve;
}

bool NurbsCurve::operator==(const NurbsCurve& other) const {
  if (data_ == other.data_) return true;
  if (data_ == nullptr || other.data_ == nullptr) return false;
  return data_->degree == other.data_->degree && data_->knots == other.data_->knots &&
         data_->controlPoints == other.data_->controlPoints && data_->weights == other.data_->weights;
}

}  // namespace batten
