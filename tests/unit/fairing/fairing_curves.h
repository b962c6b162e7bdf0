// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "core/curve/nurbs_curve.h"
#include "tests/support/clamped_knots.h"

namespace batten::test {

/// Clamped uniform knots for `count` control points over 0..1.
inline std::vector<double> clampedKnots(int degree, int count) {
  std::vector<double> knots = clampedUnitKnots(degree, count);
  for (double& knot : knots) knot /= count - degree;
  return knots;
}

/// Dense least squares through samples of `shape` over 0..1, with both ends met: slow and simple.
NurbsCurve fitted(const std::function<Vec2(double)>& shape, int count, int degree = 5);

inline NurbsCurve arc(double radius, double angle, int count) {
  return fitted([=](double t) { return Vec2(radius * std::cos(t * angle), radius * std::sin(t * angle)); }, count);
}
inline NurbsCurve wave(double length, double height, int count) {
  return fitted([=](double t) { return Vec2(length * t, height * std::sin(2.0 * std::numbers::pi * t)); }, count);
}
inline NurbsCurve ellipseQuarter(double a, double b, int count) {
  return fitted(
      [=](double t) { return Vec2(a * std::cos(t * std::numbers::pi / 2), b * std::sin(t * std::numbers::pi / 2)); },
      count);
}

/// The curve with every control point but the ends moved by a normally distributed amount.
inline NurbsCurve noisy(const NurbsCurve& curve, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, sigma);
  std::vector<Vec2> points(curve.controlPoints().begin(), curve.controlPoints().end());
  for (std::size_t i = 1; i + 1 < points.size(); ++i) points[i] += Vec2(normal(random), normal(random));
  return NurbsCurve::make(curve.degree(), {curve.knots().begin(), curve.knots().end()}, points).value();
}

/// A closed curve that meets itself with all derivatives, over clamped knots: each control point of the clamped form is
/// found by dense least squares on samples of the periodic one.
inline NurbsCurve closedCurve(const std::function<Vec2(double)>& periodicPoint, int points, int degree = 5) {
  std::vector<double> wide;
  for (int i = -degree; i <= points + degree; ++i) wide.push_back(static_cast<double>(i) / points);
  std::vector<Vec2> q;
  for (int j = 0; j < points + degree; ++j) q.push_back(periodicPoint(static_cast<double>(j % points) / points));
  const NurbsCurve periodic = NurbsCurve::make(degree, wide, q).value();
  return fitted([&](double t) { return periodic.point(t); }, points + degree, degree);
}

}  // namespace batten::test
