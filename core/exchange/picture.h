// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/vec2.h"

namespace batten {

using Colour = std::array<std::uint8_t, 3>;  ///< Red, green, blue.

/// A colour picture for dumps and previews, 3 bytes a pixel, row by row.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  Picture(int w, int h, std::uint8_t grey = 255) : width(w), height(h), rgb(3 * std::ptrdiff_t{w} * h, grey) {}
  void set(int x, int y, Colour c) {
    const std::ptrdiff_t i = 3 * (std::ptrdiff_t{y} * width + x);
    rgb[i] = c[0], rgb[i + 1] = c[1], rgb[i + 2] = c[2];
  }
};

/// A line to draw. Image frame: the first pixel covers [0,1] x [0,1].
struct PictureLine {
  std::vector<Vec2> points;  ///< [px]
  bool closed = false;
  Colour colour{};
  double widthPx = 1.0;  ///< [px]
};

/// Draws lines, antialiased, over the picture.
void drawLines(Picture&, std::span<const PictureLine>);

/// The picture as the bytes of a PNG file. @return OutOfMemory or Numerical if it is too large to encode.
Result<std::string> encodePng(const Picture&);

}  // namespace batten
