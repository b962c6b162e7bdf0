// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/rectify/sheet_map.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace batten {
namespace {

/// From the unit square, by what the corners lack of a parallelogram.
Eigen::Matrix3d fromUnitSquare(const SheetCorners& c) {
  const Vec2 d1 = c[1] - c[2], d2 = c[3] - c[2], lack = c[0] - c[1] + c[2] - c[3];
  const double area = cross(d1, d2);
  const double g = cross(lack, d2) / area, h = cross(d1, lack) / area;
  const Vec2 x = c[1] - c[0] + g * c[1], y = c[3] - c[0] + h * c[3];
  Eigen::Matrix3d m;
  m << x.x(), y.x(), c[0].x(), x.y(), y.y(), c[0].y(), g, h, 1.0;
  return m;
}

}  // namespace

SheetMap::SheetMap(const SheetCorners& corners, double widthPx, double heightPx)
    : forth_(fromUnitSquare(corners) * Eigen::Vector3d(1.0 / widthPx, 1.0 / heightPx, 1.0).asDiagonal()),
      back_(forth_.inverse()) {
  // Its sign is free: the page itself is to lie on the positive side.
  if ((back_ * corners[0].homogeneous()).z() < 0.0) back_ = -back_;
}

Vec2 SheetMap::toPicture(const Vec2& page) const { return (forth_ * page.homogeneous()).hnormalized(); }

std::optional<Vec2> SheetMap::toPage(const Vec2& picture) const {
  const Eigen::Vector3d p = back_ * picture.homogeneous();
  if (!(p.z() > 0.0)) return std::nullopt;
  return p.hnormalized();
}

Eigen::Matrix2d SheetMap::slopeAt(const Vec2& page) const {
  const Eigen::Vector3d p = forth_ * page.homogeneous();
  const Vec2 at = p.hnormalized();
  Eigen::Matrix2d slope;
  for (int k = 0; k < 2; ++k) slope.col(k) = (forth_.col(k).head<2>() - forth_(2, k) * at) / p.z();
  return slope;
}

}  // namespace batten
