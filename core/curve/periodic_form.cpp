// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/periodic_form.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/curve/curvature.h"
#include "core/curve/span_curve.h"
#include "core/solve/dense_solve.h"

namespace batten {
namespace {

/// Number k of the non-empty knot interval [knots[k], knots[k+1]) that holds t, within the domain.
std::size_t intervalOf(std::span<const double> knots, std::size_t degree, std::size_t count, double t) {
  const auto first = knots.begin() + static_cast<std::ptrdiff_t>(degree);
  const auto last = knots.begin() + static_cast<std::ptrdiff_t>(count);
  auto after = std::upper_bound(first, last, t);
  auto k = static_cast<std::size_t>(std::distance(knots.begin(), after)) - 1;
  k = std::clamp(k, degree, count - 1);
  while (k > degree && !(knots[k + 1] > knots[k])) --k;
  return k;
}

/// The blossom (polar form) of the polynomial of interval k at `arguments`: de Boor's algorithm with one argument a
/// level.
Vec2 blossom(std::span<const double> knots, std::size_t degree, const std::function<Vec2(std::size_t)>& point,
             std::size_t k, std::span<const double> arguments) {
  std::array<Vec2, kMaxFairingDegree + 1> d;
  for (std::size_t j = 0; j <= degree; ++j) d[j] = point(k - degree + j);
  for (std::size_t r = 1; r <= degree; ++r) {
    for (std::size_t j = degree; j >= r; --j) {
      const std::size_t i = k - degree + j;
      const double alpha = (arguments[r - 1] - knots[i]) / (knots[i + degree + 1 - r] - knots[i]);
      d[j] = (1.0 - alpha) * d[j - 1] + alpha * d[j];
    }
  }
  return d[degree];
}

/// Least squares over dense samples: for curves whose ends meet, but not with all derivatives.
void fitPeriodic(const NurbsCurve& curve, PeriodicForm& form) {
  const int p = curve.degree(), m = static_cast<int>(form.points.size());
  const SpanBasis basis(p, form.knots, m + p, m);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(m, m);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(m, 2);
  const int perSpan = 2 * p + 2;
  for (int s = 0; s < basis.spanCount(); ++s) {
    for (int i = 0; i < perSpan; ++i) {
      const SpanPlace place{s, (i + 0.5) / perSpan};
      const SpanRow row = basis.row(place, 0);
      const Vec2 target = curve.point(basis.parameter(place));
      for (int a = 0; a <= p; ++a) {
        right.row(basis.point(s, a)) += basis.width(s) * row.d[0][a] * target.transpose();
        for (int b = 0; b <= p; ++b) {
          normal(basis.point(s, a), basis.point(s, b)) += basis.width(s) * row.d[0][a] * row.d[0][b];
        }
      }
    }
  }
  const Eigen::MatrixXd solved = solveSymmetric(normal, right);
  if (!solved.allFinite()) return;
  for (int j = 0; j < m; ++j) form.points[j] = solved.row(j).transpose();
}

}  // namespace

Result<PeriodicForm> toPeriodic(const NurbsCurve& curve) {
  const auto p = static_cast<std::size_t>(curve.degree());
  const auto count = static_cast<std::size_t>(curve.controlPointCount());
  const auto knots = curve.knots();
  std::vector<double> cycle{curve.start()};
  for (const double t : knots) {
    if (t > curve.start() && t < curve.end()) cycle.push_back(t);
  }
  const std::size_t m = cycle.size();
  if (m < 3) return fail(ErrorCode::Numerical, "The closed curve has too few knots to be faired.");
  const double period = curve.end() - curve.start();
  PeriodicForm form;
  form.points.assign(m, Vec2::Zero());
  const auto knotAt = [&](std::ptrdiff_t i) {
    const auto size = static_cast<std::ptrdiff_t>(m);
    const std::ptrdiff_t turn = i >= 0 ? i / size : -((size - 1 - i) / size);
    if (i == size) return curve.end();
    return cycle[i - turn * size] + static_cast<double>(turn) * period;
  };
  for (std::ptrdiff_t i = -static_cast<std::ptrdiff_t>(p); i <= static_cast<std::ptrdiff_t>(m + p); ++i) {
    form.knots.push_back(knotAt(i));
  }
  const auto point = [&](std::size_t i) { return curve.controlPoints()[i]; };
  for (std::size_t j = 0; j < m; ++j) {
    const double middle = 0.5 * (form.knots[j] + form.knots[j + p + 1]);
    const double shift = std::floor((middle - curve.start()) / period) * period;
    std::vector<double> arguments(form.knots.begin() + static_cast<std::ptrdiff_t>(j + 1),
                                  form.knots.begin() + static_cast<std::ptrdiff_t>(j + p + 1));
    for (double& t : arguments) t -= shift;
    form.points[j] = blossom(knots, p, point, intervalOf(knots, p, count, middle - shift), arguments);
  }
  const auto back = fromPeriodic(form, curve);
  const double size = extent(curve);
  double miss = back ? 0.0 : size;
  if (back) {
    for (std::size_t i = 0; i < count; ++i) {
      miss = std::max(miss, (back->controlPoints()[i] - curve.controlPoints()[i]).norm());
    }
  }
  if (!(miss <= 1e-9 * size)) fitPeriodic(curve, form);
  return form;
}

Result<NurbsCurve> fromPeriodic(const PeriodicForm& form, const NurbsCurve& like) {
  const auto p = static_cast<std::size_t>(like.degree());
  const std::size_t m = form.points.size();
  const auto knots = like.knots();
  const auto point = [&](std::size_t i) { return form.points[i % m]; };
  std::vector<Vec2> points(like.controlPointCount());
  for (std::size_t j = 0; j < points.size(); ++j) {
    const double low = std::max(knots[j], like.start()), high = std::min(knots[j + p + 1], like.end());
    points[j] =
        blossom(form.knots, p, point, intervalOf(form.knots, p, m + p, 0.5 * (low + high)), knots.subspan(j + 1, p));
  }
  // The seam is one point: rounding must not open the curve.
  if (knots[p] == knots[0] && knots[points.size()] == knots[points.size() + p]) points.back() = points.front();
  return NurbsCurve::make(like.degree(), {knots.begin(), knots.end()}, std::move(points));
}

}  // namespace batten
