// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/exact_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/polyline/circle_fit.h"

namespace batten {
namespace {

constexpr double kToleranceShare = 0.5;                           // of the tolerance that an exact shape may take
constexpr double kLargestSegment = 2.0 * std::numbers::pi / 3.0;  // [rad] of a rational quadratic: weights from 1/2 up
constexpr double kAlike = 0.7;                                    // cosine: the directions of reference and shape

bool liesOn(const LightReference& reference, const Circle& circle, bool left, double most) {
  for (const LightSample& sample : reference.samples()) {
    const Vec2 out = sample.point - circle.centre;
    const double distance = out.norm();
    if (!(std::abs(distance - circle.radius) <= most)) return false;
    const Vec2 along = (left ? 1.0 : -1.0) * leftNormal(out) / distance;
    if (along.dot(sample.tangent) < kAlike) return false;
  }
  return true;
}

Result<NurbsCurve> arcCurve(const Circle& circle, const Vec2& first, const Vec2& last, double turn) {
  const int segments = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kLargestSegment - 1e-9)));
  const double step = turn / segments, weight = std::cos(0.5 * step);
  const Vec2 out = first - circle.centre;
  const double start = std::atan2(out.y(), out.x()), length = std::abs(turn) * circle.radius;
  const auto onRay = [&](double angle, double radius) -> Vec2 {
    return circle.centre + radius * Vec2(std::cos(angle), std::sin(angle));
  };
  std::vector<Vec2> points{first};
  std::vector<double> weights{1.0}, knots(3, 0.0);
  for (int i = 0; i < segments; ++i) {
    points.push_back(onRay(start + (i + 0.5) * step, circle.radius / weight));
    points.push_back(i + 1 == segments ? last : onRay(start + (i + 1) * step, circle.radius));
    weights.insert(weights.end(), {weight, 1.0});
    const double knot = length * (i + 1) / segments;
    knots.insert(knots.end(), i + 1 == segments ? 3 : 2, knot);
  }
  return NurbsCurve::make(2, std::move(knots), std::move(points), std::move(weights));
}

}  // namespace

std::optional<NurbsCurve> exactLine(const LightReference& reference, double tolerance) {
  if (reference.isClosed()) return std::nullopt;
  const Vec2 first = reference.samples().front().point, last = reference.samples().back().point;
  const double chord = (last - first).norm();
  if (!(chord > tolerance)) return std::nullopt;
  const Vec2 direction = (last - first) / chord;
  for (const LightSample& sample : reference.samples()) {
    if (!(std::abs(cross(direction, sample.point - first)) <= kToleranceShare * tolerance)) return std::nullopt;
    if (direction.dot(sample.tangent) < kAlike) return std::nullopt;
  }
  auto line = NurbsCurve::make(1, {0.0, 0.0, chord, chord}, {first, last});
  return line ? std::optional(std::move(*line)) : std::nullopt;
}

std::optional<NurbsCurve> exactArc(const LightReference& reference, double tolerance) {
  std::vector<Vec2> points;
  for (const LightSample& sample : reference.samples()) points.push_back(sample.point);
  const auto fitted = algebraicCircle(points);
  if (!fitted) return std::nullopt;
  Circle circle = *fitted;
  const Vec2 first = reference.samples().front().point, last = reference.samples().back().point;
  const bool left = cross(first - circle.centre, reference.samples().front().tangent) > 0.0;
  const double most = kToleranceShare * tolerance;
  if (!liesOn(reference, circle, left, most)) return std::nullopt;
  double turn = left ? 2.0 * std::numbers::pi : -2.0 * std::numbers::pi;
  Vec2 begin = circle.centre + circle.radius * (first - circle.centre).normalized(), end = begin;
  if (!reference.isClosed()) {
    const double chord = (last - first).norm();
    if (!(chord > tolerance)) return std::nullopt;
    const Vec2 middle = 0.5 * (first + last), across = leftNormal(last - first) / chord;
    circle.centre = middle + (circle.centre - middle).dot(across) * across;
    circle.radius = (first - circle.centre).norm();
    if (!liesOn(reference, circle, left, most)) return std::nullopt;
    begin = first;
    end = last;
    const Vec2 a = first - circle.centre, b = last - circle.centre;
    turn = std::atan2(cross(a, b), a.dot(b));
    if (left && turn < 0.0) turn += 2.0 * std::numbers::pi;
    if (!left && turn > 0.0) turn -= 2.0 * std::numbers::pi;
  }
  auto arc = arcCurve(circle, begin, end, turn);
  return arc ? std::optional(std::move(*arc)) : std::nullopt;
}

}  // namespace batten
