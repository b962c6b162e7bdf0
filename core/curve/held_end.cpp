// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/held_end.h"

#include <cmath>
#include <utility>
#include <vector>

namespace batten {
namespace {

/// Each end has its own control points: two, or three where its curvature is held.
constexpr int kPointsOfTangents = 4, kPointsOfCurvatures = 6;

std::optional<NurbsCurve> overSameKnots(const NurbsCurve& curve, std::vector<Vec2> points) {
  auto made = NurbsCurve::make(curve.degree(), {curve.knots().begin(), curve.knots().end()}, std::move(points));
  return made ? std::optional(std::move(*made)) : std::nullopt;
}

}  // namespace

std::optional<NurbsCurve> withEnd(const NurbsCurve& curve, bool atEnd, const Vec2& tangent,
                                  std::optional<double> kappa) {
  const int count = curve.controlPointCount();
  if (count < (kappa ? kPointsOfCurvatures : kPointsOfTangents)) return std::nullopt;
  std::vector<Vec2> points(curve.controlPoints().begin(), curve.controlPoints().end());
  const auto at = [&](int k) { return atEnd ? count - 1 - k : k; };
  points[at(1)] = points[at(0)] + (points[at(1)] - points[at(0)]).dot(tangent) * tangent;
  auto turned = overSameKnots(curve, points);
  if (!turned || !kappa) return turned;
  const double u = atEnd ? curve.end() : curve.start();
  const auto d = turned->derivatives(u, 2);
  // The curvature is linear in the third point's place across the tangent.
  const BasisRow row = basis(curve.degree(), curve.knots(), count, u, 2);
  const int index = at(2) - row.first;
  const double share = row.values[2][index], v2 = d[1].squaredNorm();
  const double now = cross(d[1], d[2]) / (v2 * std::sqrt(v2));
  if (!(share > 0.0) || !std::isfinite(now)) return std::nullopt;
  points[at(2)] += (*kappa - now) * v2 / share * leftNormal(tangent);
  return overSameKnots(curve, std::move(points));
}

}  // namespace batten
