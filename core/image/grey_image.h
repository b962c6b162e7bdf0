// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace batten {

/// A grey picture, 16 bits a pixel whatever the file had: 0 = black, 65535 = white. 8-bit values are stored times 257,
/// so that both depths share one path and `value / kGreyUnit` is the grey level 0..255 that all parameters speak of.
struct GreyImage {
  static constexpr double kGreyUnit = 257.0;

  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> pixels;  ///< Row by row, no padding.

  GreyImage() = default;
  GreyImage(int w, int h, std::uint16_t fill = 0xffff) : width(w), height(h), pixels(std::ptrdiff_t{w} * h, fill) {}

  std::uint16_t* row(int y) { return pixels.data() + std::ptrdiff_t{y} * width; }
  const std::uint16_t* row(int y) const { return pixels.data() + std::ptrdiff_t{y} * width; }
  /// Grey level 0..255 of a pixel. @pre inside the picture.
  double level(int x, int y) const { return row(y)[x] / kGreyUnit; }
  bool operator==(const GreyImage&) const = default;
};

}  // namespace batten
