// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <utility>

#include "core/base/conventions.h"

namespace batten {

using RegionValues = std::array<double, kRegions>;

/// 64 values at the region centres as a surface over a picture: bilinear between the centres and constant beyond them,
/// or constant in every region.
class RegionSurface {
 public:
  RegionSurface(const RegionValues& values, int width, int height, bool interpolate);
  /// Values at the pixel centres of row y, for all x of the picture.
  void fillRow(int y, float* out) const { fillRow(y, 0, width_, out); }
  /// The same values for pixels [x0, x1) alone, that of x0 first.
  void fillRow(int y, int x0, int x1, float* out) const;

  /// Bounds: in rows [y0, y1) no pixel exceeds the largest of these over the columns that act on it (columnsOf).
  std::array<double, kRegionsPerSide> highestByColumn(int y0, int y1) const;
  /// First and last column of regions that act on pixels [x0, x1).
  std::pair<int, int> columnsOf(int x0, int x1) const;

 private:
  struct Place {
    int first;     ///< Row of regions, and the next one below it.
    double share;  ///< 0..1 of the latter.
  };
  Place rowAt(int y) const;

  RegionValues values_;
  int width_, height_;
  bool interpolate_;
  /// Where the stretches between region centres begin: [i] for column i, at the end the width.
  std::array<int, kRegionsPerSide + 1> starts_{};
};

/// The region a pixel lies in. @pre inside the picture.
int regionOf(int x, int y, int width, int height);

}  // namespace batten
