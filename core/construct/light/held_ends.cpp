// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/held_ends.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/curve/curvature.h"

namespace batten {
namespace {

constexpr double kHeldAngle = 1e-4;      // [rad]
constexpr double kHeldCurvature = 0.01;  // of the largest

const LightSample& endOf(const LightReference& reference, bool atEnd) {
  return atEnd ? reference.samples().back() : reference.samples().front();
}

std::optional<NurbsCurve> remade(const NurbsCurve& curve, std::vector<Vec2> points) {
  auto made = NurbsCurve::make(curve.degree(), {curve.knots().begin(), curve.knots().end()}, std::move(points));
  return made ? std::optional(std::move(*made)) : std::nullopt;
}

/// One end. Both ends of one curve are apart as long as each has its own three control points.
std::optional<NurbsCurve> held(const NurbsCurve& curve, const LightSample& wanted, LightHold hold, bool atEnd) {
  if (hold == LightHold::Position) return curve;
  const int count = curve.controlPointCount();
  if (count < (hold == LightHold::Curvature ? 6 : 4)) return std::nullopt;
  std::vector<Vec2> points(curve.controlPoints().begin(), curve.controlPoints().end());
  const auto at = [&](int k) { return static_cast<std::size_t>(atEnd ? count - 1 - k : k); };
  points[at(1)] = points[at(0)] + (points[at(1)] - points[at(0)]).dot(wanted.tangent) * wanted.tangent;
  auto turned = remade(curve, points);
  if (!turned || hold == LightHold::Tangent) return turned;
  const double u = atEnd ? curve.end() : curve.start();
  const auto d = turned->derivatives(u, 2);
  // The curvature is linear in the third point's place across the tangent.
  const BasisRow row = basis(curve.degree(), curve.knots(), count, u, 2);
  const int index = static_cast<int>(at(2)) - row.first;
  const double share = row.values[2][index], v2 = d[1].squaredNorm();
  const double kappa = cross(d[1], d[2]) / (v2 * std::sqrt(v2));
  if (!(share > 0.0) || !std::isfinite(kappa)) return std::nullopt;
  points[at(2)] += (wanted.kappa - kappa) * v2 / share * leftNormal(wanted.tangent);
  return remade(curve, std::move(points));
}

}  // namespace

std::optional<NurbsCurve> withHeldEnds(const NurbsCurve& curve, const LightReference& reference, LightHold start,
                                       LightHold end) {
  const auto first = held(curve, endOf(reference, false), start, false);
  return first ? held(*first, endOf(reference, true), end, true) : std::nullopt;
}

bool endsAreHeld(const NurbsCurve& curve, const LightReference& reference, LightHold start, LightHold end) {
  for (const bool atEnd : {false, true}) {
    const LightHold hold = atEnd ? end : start;
    if (hold == LightHold::Position) continue;
    const LightSample& wanted = endOf(reference, atEnd);
    const double u = atEnd ? curve.end() : curve.start();
    const Vec2 tangent = curve.derivatives(u, 1)[1].normalized();
    if (!(std::abs(cross(wanted.tangent, tangent)) <= kHeldAngle) || tangent.dot(wanted.tangent) < 0.0) return false;
    if (hold == LightHold::Tangent) continue;
    const double kappa = curvature(curve, u).value_or(0.0);
    if (!(std::abs(kappa - wanted.kappa) <= kHeldCurvature * reference.largestKappa())) return false;
  }
  return true;
}

}  // namespace batten
