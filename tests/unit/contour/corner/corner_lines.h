// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/contour/trace_contours.h"
#include "tests/support/contour_shapes.h"

/// \file
/// Lines with corners and without, for the tests of corner marks and of suggestions.

namespace batten::test {

/// A letter-K like outline with gently curved sides; corners of 50 to 300 degrees.
inline CurvedPolygon letterK() {
  return {{{60, 40},
           {110, 42},
           {112, 130},
           {190, 38},
           {250, 44},
           {160, 150},
           {255, 262},
           {190, 266},
           {113, 168},
           {110, 262},
           {58, 258}},
          {3, -4, 5, 3, -6, 6, 3, -5, 4, 3, -6}};
}

inline ContourSet traceShape(const std::vector<Vec2>& outline, double noise, unsigned seed) {
  RenderSettings s;
  s.width = 310;
  s.height = 300;
  s.noise = noise;
  s.seed = seed;
  const GreyImage grey = renderShape(PolygonInside(outline), s);
  EdgeParams edges;
  edges.mode = EdgeMode::Outline;
  const auto set = traceContours(thresholdMask(grey, 135.0), grey, edges, {}, {});
  EXPECT_TRUE(set.has_value());
  return set.value_or(ContourSet{});
}

/// A contour made of exact points, closed or open.
inline ContourSet fromPoints(std::vector<Vec2> points, bool closed, double noise = 0.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss(0.0, 1.0);
  Contour c;
  c.closed = closed;
  for (Vec2& p : points) p += noise * Vec2(gauss(random), gauss(random));
  c.points = contourPoints(points, true);
  ContourSet set;
  set.contours.push_back(c);
  return set;
}

/// About (150, 150), a point every 0.8 px.
inline std::vector<Vec2> circle(double radius) {
  std::vector<Vec2> points;
  const int n = static_cast<int>(2 * std::numbers::pi * radius / 0.8);
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    points.emplace_back(150 + radius * std::cos(a), 150 + radius * std::sin(a));
  }
  return points;
}

}  // namespace batten::test
