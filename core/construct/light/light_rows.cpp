// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_rows.h"

namespace batten {

void completePlace(PlaceState& place) {
  const Vec2 &a = place.d[1], &b = place.d[2], &c = place.d[3];
  const double v2 = a.squaredNorm();
  place.speed = std::sqrt(v2);
  place.kappa = cross(a, b) / (v2 * place.speed);
  place.slope = (cross(a, c) * v2 - 3.0 * cross(a, b) * a.dot(b)) / (v2 * v2 * v2);
}

DerivativeGradients kappaGradient(const PlaceState& place) {
  const double v2 = place.speed * place.speed, v3 = v2 * place.speed;
  return {Vec2::Zero(), -leftNormal(place.d[2]) / v3 - 3.0 * place.kappa / v2 * place.d[1], leftNormal(place.d[1]) / v3,
          Vec2::Zero()};
}

DerivativeGradients slopeGradient(const PlaceState& place) {
  const Vec2 &a = place.d[1], &b = place.d[2], &c = place.d[3];
  const double v2 = place.speed * place.speed, v6 = v2 * v2 * v2;
  const double x = cross(a, b), y = cross(a, c), d = a.dot(b);
  const Vec2 byFirst = -v2 * leftNormal(c) + 2.0 * y * a + 3.0 * d * leftNormal(b) - 3.0 * x * b;
  const Vec2 bySecond = -3.0 * (d * leftNormal(a) + x * a);
  return {Vec2::Zero(), byFirst / v6 - 6.0 * place.slope / v2 * a, bySecond / v6, v2 / v6 * leftNormal(a)};
}

DerivativeGradients speedGradient(const PlaceState& place) {
  return {Vec2::Zero(), place.d[1] / place.speed, Vec2::Zero(), Vec2::Zero()};
}

DerivativeGradients tangentGradient(const PlaceState& place, const Vec2& direction) {
  const Vec2 t = place.d[1] / place.speed;
  return {Vec2::Zero(), (direction - t.dot(direction) * t) / place.speed, Vec2::Zero(), Vec2::Zero()};
}

}  // namespace batten
