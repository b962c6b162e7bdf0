// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/curve/nurbs_curve.h"

namespace batten::test {

inline NurbsCurve uniformCurve(int degree, std::vector<Vec2> points) {
  std::vector<double> knots;
  for (int i = 0; i < static_cast<int>(points.size()) + degree + 1; ++i) knots.push_back(i - degree);
  return NurbsCurve::make(degree, std::move(knots), std::move(points)).value();
}

/// A random curve: uneven knots, some repeated up to the degree, clamped or not, rational or not.
inline NurbsCurve randomCurve(std::mt19937& random, int degree, bool clampedEnds, bool rational) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int inner = 1 + static_cast<int>(random() % 6);
  std::vector<double> knots;
  double k = -3.0;
  const auto step = [&] { return k += 0.1 + unit(random); };
  for (int i = 0; i < degree; ++i) knots.push_back(clampedEnds ? k : step());
  knots.push_back(clampedEnds ? k : step());
  for (int i = 0; i < inner; ++i) {
    const double at = step();
    const int times = random() % 3 == 0 ? 1 + static_cast<int>(random() % static_cast<unsigned>(degree)) : 1;
    knots.insert(knots.end(), times, at);
  }
  const double last = step();
  for (int i = 0; i <= degree; ++i) knots.push_back(clampedEnds ? last : step());
  const std::size_t count = knots.size() - degree - 1;
  std::vector<Vec2> points;
  std::vector<double> weights;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(100.0 * unit(random) + 20.0 * static_cast<double>(i), 100.0 * unit(random) - 50.0);
    if (rational) weights.push_back(0.4 + unit(random));
  }
  return NurbsCurve::make(degree, knots, points, weights).value();
}

/// An exact circle of nine control points, counter-clockwise, domain 0..4.
inline NurbsCurve circle(double radius, const Vec2& centre) {
  const double w = std::sqrt(0.5);
  const std::vector<Vec2> unit = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  std::vector<Vec2> points;
  for (const Vec2& p : unit) points.push_back(centre + radius * p);
  return NurbsCurve::make(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, points, {1, w, 1, w, 1, w, 1, w, 1}).value();
}

/// Parameters all over the domain of a curve, borders of spans included.
inline std::vector<double> parametersOf(const NurbsCurve& curve) {
  std::vector<double> u = curve.breaks();
  for (int i = 0; i <= 97; ++i) u.push_back(curve.start() + (curve.end() - curve.start()) * i / 97.0);
  return u;
}

/// A parabola y = x^2 / (2 r) over [-a, a]: curvature 1/r in the middle, falling to both sides.
inline NurbsCurve parabola(double r, double a) {
  return NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, {{-a, a * a / (2 * r)}, {0, -a * a / (2 * r)}, {a, a * a / (2 * r)}})
      .value();
}

}  // namespace batten::test
