// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/bezier_quintics.h"

#include <algorithm>
#include <cmath>

#include "core/base/angle.h"

namespace batten {

namespace {

/// 4/5 h / a^2 and its inverse share the unit tangent and the edge.
struct EndEdge {
  double squared = 0.0;
  Vec2 normal = Vec2::Zero();

  explicit EndEdge(const Vec2& edge) : squared(edge.squaredNorm()) {
    if (squared > 0.0) normal = leftNormal(edge / std::sqrt(squared));
  }
};

}  // namespace

QuinticPoint evaluate(const Quintic& q, double t) {
  Quintic b = q;
  const auto lower = [&](std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) b[i] += t * (b[i + 1] - b[i]);
  };
  for (std::size_t n = 5; n > 2; --n) lower(n);
  const Vec2 second = 20.0 * (b[2] - 2.0 * b[1] + b[0]);
  lower(2);
  const Vec2 first = 5.0 * (b[1] - b[0]);
  lower(1);
  return {b[0], first, second};
}

Quintic elevatedToQuintic(std::span<const Vec2> points) {
  Quintic q;
  std::size_t n = points.size();
  std::ranges::copy(points, q.begin());
  for (; n < q.size(); ++n) {
    q[n] = q[n - 1];
    for (std::size_t i = n - 1; i > 0; --i) {
      const double f = static_cast<double>(i) / static_cast<double>(n);
      q[i] = f * q[i - 1] + (1.0 - f) * q[i];
    }
  }
  return q;
}

Quintic elevatedLine(const Vec2& q0, const Vec2& q1) { return elevatedToQuintic(std::array{q0, q1}); }

Quintic elevatedCubic(const Vec2& q0, const Vec2& q1, const Vec2& q2, const Vec2& q3) {
  return elevatedToQuintic(std::array{q0, q1, q2, q3});
}

Quintic elevatedQuadratic(const Vec2& q0, const Vec2& q1, const Vec2& q2) {
  return elevatedToQuintic(std::array{q0, q1, q2});
}

std::optional<double> startCurvature(const Quintic& q) {
  const EndEdge edge(q[1] - q[0]);
  if (!(edge.squared > 0.0)) return std::nullopt;
  return 0.8 * (q[2] - q[1]).dot(edge.normal) / edge.squared;
}

std::optional<double> endCurvature(const Quintic& q) {
  const EndEdge edge(q[5] - q[4]);
  if (!(edge.squared > 0.0)) return std::nullopt;
  return 0.8 * (q[3] - q[4]).dot(edge.normal) / edge.squared;
}

void setStartCurvature(Quintic& q, double curvature) {
  const EndEdge edge(q[1] - q[0]);
  q[2] += edge.normal * (1.25 * curvature * edge.squared - (q[2] - q[1]).dot(edge.normal));
}

void setEndCurvature(Quintic& q, double curvature) {
  const EndEdge edge(q[5] - q[4]);
  q[3] += edge.normal * (1.25 * curvature * edge.squared - (q[3] - q[4]).dot(edge.normal));
}

std::optional<double> equaliseJoint(Quintic& before, Quintic& after) {
  const auto left = endCurvature(before), right = startCurvature(after);
  if (!left || !right) return std::nullopt;
  const double mean = 0.5 * (*left + *right);
  setEndCurvature(before, mean);
  setStartCurvature(after, mean);
  return mean;
}

Quintic quinticHermite(const Joint& from, const Joint& to, double length) {
  Quintic q;
  q[0] = from.point;
  q[1] = q[0] + length / 5.0 * from.tangent;
  q[2] = 2.0 * q[1] - q[0] + from.kappa * length * length / 20.0 * leftNormal(from.tangent);
  q[5] = to.point;
  q[4] = q[5] - length / 5.0 * to.tangent;
  q[3] = 2.0 * q[4] - q[5] + to.kappa * length * length / 20.0 * leftNormal(to.tangent);
  return q;
}

std::optional<Vec2> tangentVertex(const Vec2& p, const Vec2& direction, const Vec2& q, const Vec2& directionAtQ) {
  const Vec2 chord = q - p;
  const double c = chord.norm(), sine = cross(direction, directionAtQ);
  if (!(c > 0.0) || !(std::abs(sine) > std::sin(0.25 * kRadPerDeg))) return std::nullopt;
  const double fromP = cross(chord, directionAtQ) / sine, toQ = cross(direction, chord) / sine;
  constexpr double kNearest =
      0.05;  // of the chord: tangents that meet at an end, or beyond it, make a path with a hook
  const auto good = [&](double distance) { return distance >= kNearest * c && distance <= (1.0 - kNearest) * c; };
  if (!good(fromP) || !good(toQ)) return std::nullopt;
  return Vec2(p + fromP * direction);
}

Result<NurbsCurve> joinedQuintics(std::span<const Quintic> path, double speed) {
  if (path.empty()) return fail(ErrorCode::Numerical, "A chain of curves needs at least one.");
  std::vector<double> knots(6, 0.0);
  std::vector<Vec2> points = {path.front()[0]};
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Quintic& q = path[i];
    const double interval = 5.0 * (q[1] - q[0]).norm() / speed, at = knots.back() + interval;
    speed = 5.0 * (q[5] - q[4]).norm() / interval;
    const bool last = i + 1 == path.size();
    points.insert(points.end(), q.begin() + 1, q.begin() + (last ? 6 : 5));
    knots.insert(knots.end(), last ? 6 : 4, at);
  }
  return NurbsCurve::make(5, std::move(knots), std::move(points));
}

Result<NurbsCurve> hermiteChain(std::span<const Joint> joints, std::span<const double> lengths) {
  if (joints.size() < 2 || lengths.size() + 1 != joints.size()) {
    return fail(ErrorCode::Numerical, "A chain of curves needs at least two joints.");
  }
  std::vector<double> knots(6, 0.0);
  std::vector<Vec2> points;
  Quintic before;
  before.fill(Vec2::Zero());
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const Quintic q = quinticHermite(joints[i], joints[i + 1], lengths[i]);
    if (i == 0) {
      points.assign(q.begin(), q.begin() + 2);
    } else {
      // The polar form with the knots (before, joint, joint, joint, next): on the line through Q3 and Q4 of the piece
      // before.
      knots.insert(knots.end(), 3, knots.back() + lengths[i - 1]);
      points.emplace_back(before[3] + (lengths[i - 1] + lengths[i]) / lengths[i - 1] * (before[4] - before[3]));
    }
    points.insert(points.end(), {q[2], q[3]});
    before = q;
  }
  points.insert(points.end(), {before[4], before[5]});
  knots.insert(knots.end(), 6, knots.back() + lengths.back());
  return NurbsCurve::make(5, std::move(knots), std::move(points));
}

}  // namespace batten
