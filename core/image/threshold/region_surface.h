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
  void fillRow(int y, float* out) const { fillRow(y, 0, width_, out); }
  /// The same values for pixels [x0, x1) alone, that of x0 first.
  void fillRow(int y, int x0, int x1, float* out) const;

  /// A row is made of nine straight stretches, divided by the region centres (or the regions' left borders).
  struct RowLine {
    float first = 0.0f, slope = 0.0f;  ///< Value of its first pixel, and what each next one adds.
  };
  using RowLines = std::array<RowLine, kRegionsPerSide + 1>;
  /// The stretches of row y, from the left.
  RowLines linesOfRow(int y) const;
  /// The stretch that pixel x lies on.
  int stretchAt(int x) const;
  /// Its first pixel.
  int startOf(int stretch) const { return stretch == 0 ? 0 : starts_[stretch - 1]; }
  /// Whether a stretch ends before pixel x.
  bool isBefore(int stretch, int x) const { return starts_[stretch] <= x; }
  /// As fillRow, with the lines of the row and the stretch of x0.
  void fillStretches(const RowLines& lines, int stretch, int x0, int x1, float* out) const;

  /// Bounds: in rows [y0, y1) no pixel of a stretch exceeds its bound by more than rounding.
  using RowBounds = std::array<float, kRegionsPerSide + 1>;
  RowBounds highestByStretch(int y0, int y1) const;

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
