// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/colour_page.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace batten::test {

Scan renderColourPage(const ColourPage& page, const std::vector<InkLayer>& inks) {
  Scan scan;
  scan.grey = GreyImage(page.width, page.height);
  scan.colour = ColourImage(page.width, page.height);
  scan.info.width = page.width;
  scan.info.height = page.height;
  scan.info.channels = 3;
  scan.dpi = 300.0;
  std::mt19937 random(page.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      const double along = (x + 0.5) / page.width;
      std::array<std::uint8_t, 3> levels{};
      for (std::size_t k = 0; k < 3; ++k) {
        double light = page.paperLeft[k] + along * (page.paperRight[k] - page.paperLeft[k]);
        for (const InkLayer& ink : inks) {
          const auto covered = static_cast<double>(ink.coverage[std::ptrdiff_t{y} * page.width + x]);
          light *= 1.0 - covered * (1.0 - ink.passes[k]);
        }
        levels[k] = static_cast<std::uint8_t>(std::clamp(std::round(light + page.noise * noise(random)), 0.0, 255.0));
      }
      scan.colour.row(y)[x] = {levels[0], levels[1], levels[2]};
      scan.grey.row(y)[x] =
          static_cast<std::uint16_t>((299 * levels[0] + 587 * levels[1] + 114 * levels[2]) * 257.0 / 1000.0 + 0.5);
    }
  }
  return scan;
}

std::vector<float> lineCoverage(int width, int height, const Vec2& a, const Vec2& b, double widthPx) {
  std::vector<float> coverage;
  const Vec2 along = (b - a).normalized();
  const double length = (b - a).norm();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vec2 p(x + 0.5, y + 0.5);
      const double t = std::clamp((p - a).dot(along), 0.0, length);
      const double away = (p - a - t * along).norm();
      coverage.push_back(static_cast<float>(std::clamp(0.5 * widthPx - away + 0.5, 0.0, 1.0)));
    }
  }
  return coverage;
}

double shareFound(const std::vector<float>& coverage, const BitImage& ink) {
  int all = 0, found = 0;
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) {
      if (coverage[std::ptrdiff_t{y} * ink.width + x] < 1.0f) continue;
      ++all;
      found += ink.at(x, y) ? 1 : 0;
    }
  }
  return all > 0 ? static_cast<double>(found) / all : 0.0;
}

}  // namespace batten::test
