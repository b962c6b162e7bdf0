// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/periodic_form.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/curve/blossom.h"
#include "core/curve/curvature.h"
#include "core/curve/span_curve.h"
#include "core/solve/banded_least_squares.h"

namespace batten {
namespace {

/// Of the extent: a curve that comes back by no more than this from its periodic form was periodic but for rounding.
constexpr double kSamePoints = 1e-9;

/// Least squares over dense samples: for curves whose ends meet, but not with all derivatives.
void fitPeriodic(const NurbsCurve& curve, PeriodicForm& form) {
  const int p = curve.degree(), m = static_cast<int>(form.points.size());
  const SpanBasis basis(p, form.knots, m + p, m);
  BandedLeastSquares system(m, p + 1, true);
  const int perSpan = 2 * p + 2;
  std::vector<double> values(p + 1);
  for (int s = 0; s < basis.spanCount(); ++s) {
    const double weight = std::sqrt(basis.width(s));
    for (int i = 0; i < perSpan; ++i) {
      const SpanPlace place{s, (i + 0.5) / perSpan};
      const SpanRow row = basis.row(place, 0);
      for (int j = 0; j <= p; ++j) values[j] = weight * row.d[0][j];
      system.add(basis.point(s, 0), values, weight * curve.point(basis.parameter(place)));
    }
  }
  if (auto solved = system.solve()) form.points = std::move(*solved);
}

}  // namespace

Result<PeriodicForm> toPeriodic(const NurbsCurve& curve) {
  const int p = curve.degree(), count = curve.controlPointCount();
  const auto knots = curve.knots();
  std::vector<double> cycle{curve.start()};
  for (const double t : knots) {
    if (t > curve.start() && t < curve.end()) cycle.push_back(t);
  }
  const int m = static_cast<int>(std::ssize(cycle));
  if (m < 3) return fail(ErrorCode::Numerical, "The closed curve has too few knots to be faired.");
  const double period = curve.end() - curve.start();
  PeriodicForm form;
  form.points.assign(cycle.size(), Vec2::Zero());
  const auto knotAt = [&](int i) {
    if (i == m) return curve.end();
    const int lap = i >= 0 ? i / m : -((m - 1 - i) / m);
    return cycle[i - lap * m] + lap * period;
  };
  for (int i = -p; i <= m + p; ++i) form.knots.push_back(knotAt(i));
  const auto knot = [&](int i) { return knots[i]; };
  const auto point = [&](int i) { return curve.controlPoints()[i]; };
  for (int j = 0; j < m; ++j) {
    const double middle = 0.5 * (form.knots[j] + form.knots[j + p + 1]);
    const double shift = std::floor((middle - curve.start()) / period) * period;
    std::vector<double> arguments(form.knots.begin() + j + 1, form.knots.begin() + j + p + 1);
    for (double& t : arguments) t -= shift;
    form.points[j] = blossom(p, knot, point, spanOf(p, knots, count, middle - shift), arguments.data());
  }
  const auto back = fromPeriodic(form, curve);
  const double size = extent(curve);
  double miss = back ? 0.0 : size;
  if (back) {
    for (int i = 0; i < count; ++i) {
      miss = std::max(miss, (back->controlPoints()[i] - curve.controlPoints()[i]).norm());
    }
  }
  if (!(miss <= kSamePoints * size)) fitPeriodic(curve, form);
  return form;
}

Result<NurbsCurve> fromPeriodic(const PeriodicForm& form, const NurbsCurve& like) {
  const int p = like.degree(), count = like.controlPointCount(), m = static_cast<int>(std::ssize(form.points));
  const auto knots = like.knots();
  const auto knot = [&](int i) { return form.knots[i]; };
  const auto point = [&](int i) { return form.points[i % m]; };
  std::vector<Vec2> points;
  for (int j = 0; j < count; ++j) {
    const double low = std::max(knots[j], like.start()), high = std::min(knots[j + p + 1], like.end());
    points.push_back(blossom(p, knot, point, spanOf(p, form.knots, m + p, 0.5 * (low + high)), &knots[j + 1]));
  }
  // The seam is one point: rounding must not open the curve.
  if (knots[p] == knots[0] && knots[count] == knots[count + p]) points.back() = points.front();
  return NurbsCurve::make(p, {knots.begin(), knots.end()}, std::move(points));
}

}  // namespace batten
