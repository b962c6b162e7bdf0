// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/fairing/fairing_curves.h"

#include <Eigen/QR>

namespace batten::test {

NurbsCurve fitted(const std::function<Vec2(double)>& shape, int count, int degree) {
  const std::vector<double> knots = clampedKnots(degree, count);
  const int samples = 8 * count;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(samples + 1, count);
  Eigen::MatrixXd y(samples + 1, 2);
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples, w = i == 0 || i == samples ? 1e4 : 1.0;
    const BasisRow row = basis(degree, knots, count, t, 0);
    for (int j = 0; j <= degree; ++j) a(i, row.first + j) = w * row.values[0][j];
    y.row(i) = w * shape(t).transpose();
  }
  const Eigen::MatrixXd q = a.colPivHouseholderQr().solve(y);
  std::vector<Vec2> points;
  for (int j = 0; j < count; ++j) points.emplace_back(q(j, 0), q(j, 1));
  points.front() = shape(0.0);
  points.back() = shape(1.0);
  return NurbsCurve::make(degree, knots, points).value();
}

}  // namespace batten::test
