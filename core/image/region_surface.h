// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/base/conventions.h"

namespace batten {

using RegionValues = std::array<double, kRegions>;

/// 64 values at the region centres as a surface over a picture: bilinear between the centres and constant beyond them,
/// or constant in every region.
class RegionSurface {
 public:
  RegionSurface(const RegionValues& values, int width, int height, bool interpolate);
  /// Values at the pixel centres of row y, for all x of the picture.
  void fillRow(int y, float* out) const;

 private:
  RegionValues values_;
  int width_, height_;
  bool interpolate_;
};

/// The region a pixel lies in. @pre inside the picture.
int regionOf(int x, int y, int width, int height);

}  // namespace batten
