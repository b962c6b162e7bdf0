// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/polyline/circle_fit.h"

#include <Eigen/LU>
#include <cmath>

namespace batten {

std::optional<Circle> algebraicCircle(std::span<const Vec2> points, std::span<const double> weights) {
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  Vec2 mean = Vec2::Zero();
  double total = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    mean += weight(i) * points[i];
    total += weight(i);
  }
  if (points.size() < 3 || !(total > 0.0)) return std::nullopt;
  mean /= total;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 p = points[i] - mean;
    const Eigen::Vector3d row(2.0 * p.x(), 2.0 * p.y(), 1.0);
    normal += weight(i) * row * row.transpose();
    right += weight(i) * p.squaredNorm() * row;
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(normal);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Vector3d solved = solver.solve(right);
  const double squared = solved[2] + solved.head<2>().squaredNorm();
  if (!solved.allFinite() || !(squared > 0.0)) return std::nullopt;
  return Circle{mean + solved.head<2>(), std::sqrt(squared)};
}

}  // namespace batten
