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
  static constexpr double kGreyUnit = 257.0;  // of one level of 8 bits, as 255 times it is 65535

  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> pixels;  ///< Row by row, no padding; of a uniform picture one row only.
  bool isUniform = false;             ///< All rows are the first: a page of one tone, which is not written to.

  GreyImage() = default;
  GreyImage(int w, int h, std::uint16_t fill = 0xffff) : width(w), height(h), pixels(std::ptrdiff_t{w} * h, fill) {}

  /// A picture of one tone, which takes the memory of a row.
  static GreyImage uniform(int w, int h, std::uint16_t fill) {
    GreyImage image(w, 1, fill);
    image.height = h;
    image.isUniform = true;
    return image;
  }

  /// How far apart a pixel and the one below it lie in `pixels`.
  std::ptrdiff_t pitch() const { return isUniform ? 0 : width; }
  /// @pre not uniform
  std::uint16_t* row(int y) { return pixels.data() + y * pitch(); }
  const std::uint16_t* row(int y) const { return pixels.data() + y * pitch(); }
  /// Grey level 0..255 of a pixel. @pre inside the picture.
  double level(int x, int y) const { return row(y)[x] / kGreyUnit; }
  bool operator==(const GreyImage&) const = default;
};

}  // namespace batten
