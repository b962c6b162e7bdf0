// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "core/image/rectification.h"
#include "core/image/scan.h"

namespace batten::test {

/// A sheet on a table, and the camera above it.
struct PhotoPose {
  double widthMm = 210.0, heightMm = 297.0;
  double tiltDeg = 0.0, panDeg = 0.0, rollDeg = 0.0;  ///< About the axis across the picture, down it, and of the lens.
  double focal35Mm = 27.0;
  double fill = 0.75;  ///< Height of the sheet seen from the front as a share of the picture's.
};

/// The pinhole camera of a pose, worked out from its angles alone.
class PhotoCamera {
 public:
  PhotoCamera(const PhotoPose&, int widthPx, int heightPx);
  Vec2 toPicture(const Vec2& mm) const;  ///< Of a place of the sheet's plane, from its upper left corner.
  Vec2 toSheet(const Vec2& px) const;
  SheetCorners corners() const;  ///< Clockwise from the sheet's own upper left one.
  const PhotoPose& pose() const { return pose_; }
  int widthPx() const { return width_; }
  int heightPx() const { return height_; }

 private:
  PhotoPose pose_;
  int width_, height_;
  Eigen::Matrix3d forth_, back_;
};

struct PhotoStyle {
  double paper = 225.0, table = 90.0;     ///< [grey]
  double noise = 2.0, tableRough = 12.0;  ///< [grey] standard deviations.
  bool isColour = false;                  ///< A warm table, as colours.
  std::uint32_t seed = 1;
};
/// @param darkness 0..1 of the ink at a place of the sheet, mm from its upper left corner.
Scan renderPhoto(const PhotoCamera&, const std::function<double(const Vec2&)>& darkness, const PhotoStyle& = {});

}  // namespace batten::test
