// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/large_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace batten::test {
namespace {

constexpr double kPaperLeft = 245.0, kPaperRight = 190.0, kInk = 30.0, kNoise = 4.0;  // [grey]
constexpr double kThinnest = 5.0, kWidest = 12.0;                                     // [px]

/// Covers the page with a disc whose border is as soft as a pixel.
void stamp(std::vector<std::uint8_t>& coverage, int width, int height, const Vec2& at, double radius) {
  const int x0 = std::max(0, static_cast<int>(at.x() - radius - 1)),
            x1 = std::min(width - 1, static_cast<int>(at.x() + radius + 1));
  const int y0 = std::max(0, static_cast<int>(at.y() - radius - 1)),
            y1 = std::min(height - 1, static_cast<int>(at.y() + radius + 1));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double inside = radius + 0.5 - (Vec2(x + 0.5, y + 0.5) - at).norm();
      const auto share = static_cast<std::uint8_t>(255.0 * std::clamp(inside, 0.0, 1.0));
      std::uint8_t& pixel = coverage[std::ptrdiff_t{y} * width + x];
      pixel = std::max(pixel, share);
    }
}

}  // namespace

Scan largePage(int width, int height, int strokes, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<std::uint8_t> coverage(std::ptrdiff_t{width} * height, 0);
  // One stroke a cell of a grid, a wave across it: they come near each other and seldom cross.
  const int across = std::max(1, static_cast<int>(std::lround(std::sqrt(strokes / 2.0))));
  const int down = (strokes + across - 1) / across;
  for (int k = 0; k < strokes; ++k) {
    const double cellW = static_cast<double>(width) / across, cellH = static_cast<double>(height) / down;
    const Vec2 corner(k % across * cellW, k / across * cellH);
    const double radius = 0.5 * (kThinnest + (kWidest - kThinnest) * share(random));
    const double rise = (0.1 + 0.25 * share(random)) * cellH, waves = 0.5 + share(random), phase = 7.0 * share(random);
    const double length = 1.2 * cellW;
    for (double s = 0.0; s <= length; s += 0.5) {
      const double t = s / length;
      const Vec2 at = corner + Vec2((0.06 + 0.88 * t) * cellW,
                                    0.5 * cellH + rise * std::sin(phase + 2.0 * std::numbers::pi * waves * t));
      stamp(coverage, width, height, at, radius);
    }
  }
  // Values of the normal distribution by a table: a page has more pixels than need one each.
  std::normal_distribution<double> normal(0.0, kNoise);
  std::array<double, 1 << 16> table;
  for (double& value : table) value = normal(random);
  Scan scan;
  scan.grey = GreyImage(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::ptrdiff_t i = std::ptrdiff_t{y} * width + x;
      const double paper = kPaperLeft + (kPaperRight - kPaperLeft) * x / width;
      const double grey = paper + (kInk - paper) * coverage[i] / 255.0 + table[random() & 0xffff];
      scan.grey.pixels[i] = static_cast<std::uint16_t>(257 * std::clamp(static_cast<int>(std::lround(grey)), 0, 255));
    }
  scan.info = {.format = "PNG", .width = width, .height = height, .dpi = 600.0, .focal35Mm = {}};
  scan.dpi = 600.0;
  return scan;
}

}  // namespace batten::test
