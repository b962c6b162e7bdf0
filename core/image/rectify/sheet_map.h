// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/image/rectification.h"

namespace batten {

/// The perspective map between a rectangular page and the picture of it.
class SheetMap {
 public:
  /// @pre the corners are those of a convex quadrilateral.
  SheetMap(const SheetCorners&, double widthPx, double heightPx);
  explicit SheetMap(const Rectification& r) : SheetMap(r.cornersPx, r.widthPx, r.heightPx) {}

  /// [px] Where a place of the page lies on the picture.
  Vec2 toPicture(const Vec2& page) const;
  /// Absent: that place of the picture lies on or beyond the horizon of the sheet's plane.
  std::optional<Vec2> toPage(const Vec2& picture) const;
  /// [px of the picture per px of the page] Derivative of toPicture().
  Eigen::Matrix2d slopeAt(const Vec2& page) const;
  /// Homogeneous, page to picture.
  const Eigen::Matrix3d& matrix() const { return forth_; }

 private:
  Eigen::Matrix3d forth_, back_;
};

}  // namespace batten
