// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/implied_borders.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace batten {
namespace {

constexpr int kRoundingPoints = 4;  // to each side, where the border of the shape bends into that of the stroke

// The crack lies between two pixels; one of them is the shape's.
bool isBesideStroke(const Vec2& crack, const BitImage& strokes) {
  const int x = static_cast<int>(std::floor(crack.x())), y = static_cast<int>(std::floor(crack.y()));
  const bool isVertical = crack.x() == std::floor(crack.x());
  return strokes.at(x, y) || (isVertical ? strokes.at(x - 1, y) : strokes.at(x, y - 1));
}

std::vector<bool> mouthsOf(const Contour& outline, const BitImage& strokes) {
  const int n = static_cast<int>(outline.points.size());
  std::vector<bool> mouth(outline.points.size(), false);
  for (int i = 0; i < n; ++i) {
    if (!isBesideStroke(outline.points[i].unrefined, strokes)) continue;
    for (int k = -kRoundingPoints; k <= kRoundingPoints; ++k) mouth[((i + k) % n + n) % n] = true;
  }
  return mouth;
}

// Straight from rim to rim; where that would cut much of the shape off, as of a knot that the stroke is led through,
// along the end of the shape's ink.
std::vector<Vec2> acrossMouth(const Vec2& from, std::span<const ContourPoint> rim, const Vec2& to) {
  constexpr double kMostSag = 0.3, kMostSagPx = 2.0;  // [of the way across]
  const Vec2 chord = to - from;
  double sag = 0.0;
  for (const ContourPoint& p : rim) sag = std::max(sag, std::abs(cross(chord, Vec2(p.at - from))));
  const double length = chord.norm();
  std::vector<Vec2> points;
  if (length > 0.0 && sag / length <= std::max(kMostSagPx, kMostSag * length)) {
    const int steps = std::max(1, static_cast<int>(std::lround(length)));
    for (int k = 1; k < steps; ++k) points.push_back(from + chord * (static_cast<double>(k) / steps));
    return points;
  }
  constexpr int kReach = 3;  // points to each side that even out the steps of the pixels
  const int n = static_cast<int>(rim.size());
  for (int i = 0; i < n; ++i) {
    const int reach = std::min({kReach, i, n - 1 - i});
    Vec2 sum = Vec2::Zero();
    for (int k = i - reach; k <= i + reach; ++k) sum += rim[k].at;
    points.push_back(sum / (2.0 * reach + 1.0));
  }
  return points;
}

}  // namespace

void implyBorders(Contour& outline, const BitImage& strokes) {
  if (!outline.closed) return;
  std::vector<bool> mouth = mouthsOf(outline, strokes);
  const auto own = std::find(mouth.begin(), mouth.end(), false);
  // Without any border of its own it stays as the labels lie.
  if (own == mouth.end() || std::find(mouth.begin(), mouth.end(), true) == mouth.end()) return;
  const auto offset = own - mouth.begin();
  std::rotate(mouth.begin(), own, mouth.end());
  std::rotate(outline.points.begin(), outline.points.begin() + offset, outline.points.end());
  std::vector<ContourPoint> points;
  const int n = static_cast<int>(mouth.size());
  for (int i = 0; i < n; ++i) {
    if (!mouth[i]) {
      points.push_back(outline.points[i]);
      continue;
    }
    int last = i;
    while (last + 1 < n && mouth[last + 1]) ++last;
    const int first = static_cast<int>(points.size());
    const std::span<const ContourPoint> rim(outline.points.data() + i, last - i + 1);
    for (const Vec2& at : acrossMouth(points.back().at, rim, outline.points[(last + 1) % n].at))
      points.push_back({.at = at, .unrefined = at});
    if (std::ssize(points) > first) outline.bridges.emplace_back(first, static_cast<int>(points.size()) - 1);
    i = last;
  }
  outline.points = std::move(points);
  measureContour(outline);
}

}  // namespace batten
