// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction/arc_through.h"

#include <Eigen/Cholesky>

namespace batten {

Vec2 LocalArc::toArc(const Vec2& p) const {
  const double f = abc[0] + abc[1] * p.x() + abc[2] * p.squaredNorm() - p.y();
  const Vec2 gradient = gradientAt(p);
  return -f / gradient.squaredNorm() * gradient;
}

Vec2 LocalFrame::local(const Vec2& p) const {
  const Vec2 d = p - origin;
  return {along.dot(d), cross(along, d)};
}

Vec2 LocalFrame::page(const Vec2& d) const { return d.x() * along + d.y() * leftNormal(along); }

std::optional<LocalArc> arcThrough(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::vector<Vec2>* part : {&a, &b}) {
    for (const Vec2& p : *part) {
      const Eigen::Vector3d row(1.0, p.x(), p.squaredNorm());
      normal += row * row.transpose() / static_cast<double>(part->size());
      right += p.y() * row / static_cast<double>(part->size());
    }
  }
  const Eigen::LDLT<Eigen::Matrix3d> factors(normal);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const LocalArc arc{factors.solve(right)};
  return arc.abc.allFinite() ? std::optional(arc) : std::nullopt;
}

double squaresLeft(const LocalArc& arc, const std::vector<Vec2>& points) {
  double sum = 0.0;
  for (const Vec2& p : points) sum += arc.toArc(p).squaredNorm();
  return sum / static_cast<double>(points.size());
}

}  // namespace batten
