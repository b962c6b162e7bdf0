// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

/// What a pixel shows of an edge in one direction, as a table: see PixelResponse.
struct ResponseRow {
  static constexpr int kPerPx = 32;  ///< Entries a pixel; linear between them.
  const float* values = nullptr;     ///< Part and slope, part and slope ... at the distances k / kPerPx - range.
  double range = 0.0;                ///< [px]
  int columns = 0;                   ///< Entries of the table.

  struct Value {
    double part;   ///< 0..1: how much of the pixel is ink.
    double slope;  ///< [1/px] its derivative with respect to the distance.
  };
  /// For a pixel whose centre is `distance` px inside the ink (negative: outside).
  Value at(double distance) const {
    const double place = (distance + range) * kPerPx;
    if (!(place > 0.0)) return {0.0, 0.0};
    if (place >= columns - 2) return {1.0, 0.0};
    const int k = static_cast<int>(place);
    const double f = place - k;
    const float* v = values + 2 * k;
    return {v[0] + f * (v[2] - v[0]), v[1] + f * (v[3] - v[1])};
  }
};

}  // namespace batten
