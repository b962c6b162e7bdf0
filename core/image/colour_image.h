// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace batten {

/// One pixel of a colour scan, 0..255 a channel.
struct Rgb8 {
  std::uint8_t red = 255, green = 255, blue = 255;
  bool isGrey() const { return red == green && green == blue; }
  bool operator==(const Rgb8&) const = default;
};

/// The colours of a scan, 8 bits a channel whatever the file had: positions and edges come from the grey picture, which
/// keeps all bits. Empty for a scan without colour.
struct ColourImage {
  int width = 0;
  int height = 0;
  std::vector<Rgb8> pixels;  ///< Row by row, no padding.

  ColourImage() = default;
  ColourImage(int w, int h) : width(w), height(h), pixels(std::ptrdiff_t{w} * h) {}

  bool isEmpty() const { return pixels.empty(); }
  Rgb8* row(int y) { return pixels.data() + std::ptrdiff_t{y} * width; }
  const Rgb8* row(int y) const { return pixels.data() + std::ptrdiff_t{y} * width; }
  bool operator==(const ColourImage&) const = default;
};

}  // namespace batten
