// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/polyline/thinning.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/polyline/polyline_tools.h"

namespace batten {

namespace {

/// A stretch of points between two that are kept.
struct Stretch {
  int from, to;
};

/// The inner point of a stretch that lies farthest from its chord, and farther than the tolerance.
std::optional<int> farthestPoint(std::span<const Vec2> points, const Stretch& stretch, double tolerance) {
  std::optional<int> farthest;
  double largest = tolerance;
  for (int i = stretch.from + 1; i < stretch.to; ++i) {
    const double d = awayFromSegment(points[i], points[stretch.from], points[stretch.to]).norm();
    if (d > largest) {
      largest = d;
      farthest = i;
    }
  }
  return farthest;
}

}  // namespace

std::vector<int> pointsThatStay(int count, std::span<const int> sharp) {
  if (count <= 0) return {};
  std::vector<int> all = {0};
  for (const int s : sharp) {
    if (s > all.back() && s < count - 1) all.push_back(s);
  }
  if (count > 1) all.push_back(count - 1);
  return all;
}

std::vector<int> thinnedByStep(std::span<const Vec2> points, std::span<const int> sharp, double step) {
  if (points.empty()) return {};
  if (!(step > 0.0)) {
    std::vector<int> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  const std::vector<double> length = cumulativeLength(points);
  const std::vector<int> keep = pointsThatStay(static_cast<int>(std::ssize(points)), sharp);
  std::vector<int> result = {0};
  for (std::size_t k = 0; k + 1 < keep.size(); ++k) {
    const double from = length[keep[k]], to = length[keep[k + 1]];
    const double possible = std::floor((to - from) / step);
    const int parts = static_cast<int>(std::clamp(possible, 1.0, static_cast<double>(points.size())));
    for (int i = 1; i < parts; ++i) {
      const double wanted = from + (to - from) * i / parts;
      auto near = std::lower_bound(length.begin(), length.end(), wanted);
      if (near != length.begin() && wanted - *(near - 1) < *near - wanted) --near;
      const int index = static_cast<int>(near - length.begin());
      if (index > result.back() && index < keep[k + 1]) result.push_back(index);
    }
    result.push_back(keep[k + 1]);
  }
  return result;
}

std::vector<int> thinnedByTolerance(std::span<const Vec2> points, std::span<const int> sharp, double tolerance) {
  if (points.empty()) return {};
  std::vector<bool> stays(points.size(), false);
  const std::vector<int> keep = pointsThatStay(static_cast<int>(std::ssize(points)), sharp);
  for (const int k : keep) stays[k] = true;
  std::vector<Stretch> open;  // a list of its own: long lines must not exhaust the call stack
  for (std::size_t k = 0; k + 1 < keep.size(); ++k) open.push_back({keep[k], keep[k + 1]});
  while (!open.empty()) {
    const Stretch stretch = open.back();
    open.pop_back();
    const auto farthest = farthestPoint(points, stretch, tolerance);
    if (!farthest) continue;
    stays[*farthest] = true;
    open.push_back({stretch.from, *farthest});
    open.push_back({*farthest, stretch.to});
  }
  std::vector<int> result;
  for (int i = 0; i < std::ssize(points); ++i) {
    if (stays[i]) result.push_back(i);
  }
  return result;
}

}  // namespace batten
