// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/scan.h"

namespace batten::test {

/// Lines well apart on a page, and where they turn sharply [px].
struct CornerPage {
  int width = 0, height = 0;
  std::vector<std::vector<Vec2>> lines;
  std::vector<Vec2> corners;
};

/// Twelve zigzags of five corners, in all directions.
struct Zigzags {
  double turnRad = 1.0;
  double legPx = 20.0;
  double radiusPx = 0.0;  ///< Of what rounds the corners.
};
CornerPage zigzagPage(const Zigzags&, std::uint32_t seed);

/// Twelve smooth lines in all directions, whose smallest radius is given.
enum class Smooth {
  Circle,
  Ellipse,  ///< 3 : 1.
  Wave,     ///< Two periods, 32 degrees to either side.
};
CornerPage smoothPage(Smooth, double radiusPx, std::uint32_t seed);

/// Drawn with a round pen, blurred, with noise [grey]. @param closed of the lines.
Scan scanOfCorners(const CornerPage&, bool closed, double widthPx, double blurPx, double noise, std::uint32_t seed);

}  // namespace batten::test
