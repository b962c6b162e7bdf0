// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/curvature_rows.h"

#include <cmath>

namespace batten {

CurvatureJet curvatureJet(const Jet& r) {
  CurvatureJet result;
  const double s2 = r[1].squaredNorm(), s4 = s2 * s2, s6 = s4 * s2;
  const double c1 = cross(r[1], r[2]), c2 = cross(r[1], r[3]), d = r[1].dot(r[2]);
  result.speed = std::sqrt(s2);
  result.kappa = c1 / (s2 * result.speed);
  result.slope = c2 / s4 - 3.0 * c1 * d / s6;
  const double change = (cross(r[1], r[4]) + cross(r[2], r[3])) / s4 - 7.0 * c2 * d / s6 -
                        3.0 * c1 * (r[2].squaredNorm() + r[1].dot(r[3])) / s6 + 18.0 * c1 * d * d / (s6 * s2);
  result.bend = change / result.speed;
  return result;
}

CurvatureWeights curvatureWeights(const Jet& r) {
  const double s2 = r[1].squaredNorm(), s3 = s2 * std::sqrt(s2), kappa = cross(r[1], r[2]) / s3;
  // a x b with a = N e_x is N b_y, with a = N e_y is -N b_x.
  return {Vec2(r[2].y(), -r[2].x()) / s3 - 3.0 * kappa / s2 * r[1], Vec2(-r[1].y(), r[1].x()) / s3};
}

LocalRow curvatureRow(const Jet& r, const SpanRow& basis, int degree) {
  const auto [first, second] = curvatureWeights(r);
  LocalRow row;
  row.fill(Vec2::Zero());
  for (int j = 0; j <= degree; ++j) {
    row[j] = basis.d[1][j] * first + basis.d[2][j] * second;
  }
  return row;
}

LocalRow curvatureSlopeRow(const Jet& r, const SpanRow& basis, int degree) {
  const double s2 = r[1].squaredNorm(), s4 = s2 * s2, s6 = s4 * s2;
  const double c1 = cross(r[1], r[2]), c2 = cross(r[1], r[3]), d = r[1].dot(r[2]);
  const Vec2 first = Vec2(r[3].y(), -r[3].x()) / s4 - 4.0 * c2 / s6 * r[1] -
                     3.0 / s6 * (d * Vec2(r[2].y(), -r[2].x()) + c1 * r[2]) + 18.0 * c1 * d / (s6 * s2) * r[1];
  const Vec2 second = -3.0 / s6 * (d * Vec2(-r[1].y(), r[1].x()) + c1 * r[1]);
  const Vec2 third = Vec2(-r[1].y(), r[1].x()) / s4;
  LocalRow row;
  row.fill(Vec2::Zero());
  for (int j = 0; j <= degree; ++j) {
    row[j] = basis.d[1][j] * first + basis.d[2][j] * second + basis.d[3][j] * third;
  }
  return row;
}

}  // namespace batten
