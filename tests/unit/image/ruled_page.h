// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/image/threshold/binarize.h"
#include "tests/support/colour_page.h"

/// Pages of ruled paper with a drawing on it, and what is wrong with their ink.
namespace batten::test {

inline constexpr int kRuledWidth = 760, kRuledHeight = 900;
inline constexpr std::array<double, 3> kPen{0.12, 0.12, 0.12};

/// Share of a pixel that lies within half of `width` of the zero line of a field whose gradient has unit length.
inline float covered(double away, double width) {
  return static_cast<float>(std::clamp(0.5 * width - std::fabs(away) + 0.5, 0.0, 1.0));
}

inline std::vector<float> layer(const std::function<float(double, double)>& at) {
  std::vector<float> coverage;
  for (int y = 0; y < kRuledHeight; ++y) {
    for (int x = 0; x < kRuledWidth; ++x) coverage.push_back(at(x + 0.5, y + 0.5));
  }
  return coverage;
}

struct Ruling {
  double spacing = 31.0, width = 1.6, turnedDeg = 0.0, bendPx = 0.0, perspective = 0.0;
  bool runsDown = false;
};

/// How far a place lies from the nearest line of the ruling.
inline double offLine(const Ruling& r, double x, double y) {
  const double angle = r.turnedDeg * std::numbers::pi / 180.0;
  const double u = x - 0.5 * kRuledWidth, v = y - 0.5 * kRuledHeight;
  double across = r.runsDown ? std::cos(angle) * u + std::sin(angle) * v : -std::sin(angle) * u + std::cos(angle) * v;
  const double along = r.runsDown ? v / kRuledHeight : u / kRuledWidth;
  across += r.bendPx * 4.0 * along * along;
  const double spacing = r.spacing * (1.0 + r.perspective * along);
  return across - spacing * std::round(across / spacing);
}

inline std::vector<float> ruling(const Ruling& r) {
  return layer([&](double x, double y) { return covered(offLine(r, x, y), r.width); });
}

/// Two rings and a wave, 5 px wide.
inline double offDrawing(double x, double y) {
  const double rings =
      std::min(std::fabs(std::hypot(x - 380.0, y - 330.0) - 210.0), std::fabs(std::hypot(x - 300.0, y - 420.0) - 90.0));
  const double slope = 70.0 * std::cos(x / 60.0) / 60.0;
  const double wave = std::fabs(y - 720.0 - 70.0 * std::sin(x / 60.0)) / std::sqrt(1.0 + slope * slope);
  return x > 60.0 && x < 700.0 ? std::min(rings, wave) : rings;
}
inline std::vector<float> drawing() {
  return layer([](double x, double y) { return covered(offDrawing(x, y), 5.0); });
}

inline Scan paperWith(const std::vector<InkLayer>& inks, double noise = 1.5) {
  ColourPage page;
  page.width = kRuledWidth;
  page.height = kRuledHeight;
  page.paperLeft = {236, 236, 236};
  page.paperRight = {222, 222, 222};
  page.noise = noise;
  return renderColourPage(page, inks);
}

inline std::array<double, 3> light(double passes) { return {passes, passes, passes}; }

inline BitImage inkOf(const GreyImage& grey) {
  const auto thresholds = findThresholds(grey, {}, {}, {});
  return *binarize(grey, *thresholds, {}, {});
}

/// Ink farther than this from the drawing, and drawing without ink.
struct Wrong {
  int beside = 0;
  double missed = 0.0;
};
inline Wrong wrongInk(const BitImage& ink) {
  Wrong wrong;
  int all = 0, missed = 0;
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) {
      const double off = offDrawing(x + 0.5, y + 0.5);
      if (off > 5.0 && ink.at(x, y)) ++wrong.beside;
      if (off > 1.5) continue;
      ++all;
      missed += ink.at(x, y) ? 0 : 1;
    }
  }
  wrong.missed = static_cast<double>(missed) / all;
  return wrong;
}

}  // namespace batten::test
