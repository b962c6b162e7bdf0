// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/segment_foot.h"
#include "core/base/vec2.h"

namespace batten {

/// Index into a ring of `n` entries: any integer is folded into 0..n-1. @pre n > 0.
inline int wrapIndex(int i, int n) {
  const int r = i % n;
  return r < 0 ? r + n : r;
}

/// Length of a polyline; a closed one includes the way from the last point to the first. [unit of the points]
double polylineLength(std::span<const Vec2> points, bool closed);

/// Absolute area enclosed by a closed polyline (shoelace). [unit^2]
double polygonArea(std::span<const Vec2> points);

/// Arc length at every point, starting at 0. Same size.
std::vector<double> cumulativeLength(std::span<const Vec2> points);

/// The way to p from the place of the segment a-b that is nearest to it.
inline Vec2 awayFromSegment(const Vec2& p, const Vec2& a, const Vec2& b) { return footOnSegment(p, a, b).away; }

/// Gaussian smoothing over the index (points about evenly spaced), sigma in samples. Closed: periodic. Open: the
/// continuation beyond an end is the point mirrored at that end, so that ends stay where they are.
std::vector<Vec2> smoothPolyline(std::span<const Vec2> points, bool closed, double sigma);
/// The same for a sequence of numbers; open ends are continued by reflection, so that no slope is invented.
std::vector<float> smoothValues(std::span<const float> values, bool closed, double sigma);

/// The point at index `place` (0..n-1; closed: 0..n) by cubic convolution (Catmull-Rom; open ends are mirrored, so that
/// lines stay lines). @pre at least 2 points.
Vec2 pointBetween(std::span<const Vec2> points, bool closed, double place);

/// Unit directions by central differences over +-`reach` points (one-sided at open ends). Where points coincide the
/// direction of the neighbour is kept.
std::vector<Vec2> directions(std::span<const Vec2> points, bool closed, int reach);

/// A parabola r(s) = r0 + r1 s + r2 s^2 / 2 through points at positions s by weighted least squares: r1 is the first
/// and r2 the second derivative at s = 0.
struct LocalQuadratic {
  Vec2 r0 = Vec2::Zero(), r1 = Vec2::Zero(), r2 = Vec2::Zero();
  double residualRms = 0.0;  ///< [unit of the points] By weight.
  std::optional<int> order;  ///< 2 parabola, 1 line, 0 mean (too few different positions); absent: no points.
  Vec2 at(double s) const { return r0 + s * (r1 + 0.5 * s * r2); }
  Vec2 derivative(double s) const { return r1 + s * r2; }
};
/// `weights` may be empty (all 1). Falls back to a line or a mean when the positions do not determine more.
LocalQuadratic fitLocalQuadratic(std::span<const double> s, std::span<const Vec2> points,
                                 std::span<const double> weights, int maxOrder = 2);

}  // namespace batten
