// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/contour_set.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/polyline/polyline_tools.h"

namespace batten {

std::vector<ContourPoint> contourPoints(std::span<const Vec2> positionsPx, bool refined) {
  std::vector<ContourPoint> points;
  points.reserve(positionsPx.size());
  for (const Vec2& at : positionsPx) points.push_back({.at = at, .unrefined = at, .refined = refined});
  return points;
}

std::vector<Vec2> positionsOf(std::span<const ContourPoint> points) {
  std::vector<Vec2> at;
  at.reserve(points.size());
  for (const ContourPoint& p : points) at.push_back(p.at);
  return at;
}

std::vector<Vec2> unrefinedPositionsOf(std::span<const ContourPoint> points) {
  std::vector<Vec2> at;
  at.reserve(points.size());
  for (const ContourPoint& p : points) at.push_back(p.unrefined);
  return at;
}

std::vector<float> strokeWidthsOf(std::span<const ContourPoint> points) {
  std::vector<float> widthsPx;
  widthsPx.reserve(points.size());
  for (const ContourPoint& p : points)
    if (p.widthPx) widthsPx.push_back(*p.widthPx);
  return widthsPx;
}

bool hasStrokeWidths(std::span<const ContourPoint> points) {
  return std::ranges::any_of(points, [](const ContourPoint& p) { return p.widthPx.has_value(); });
}

void measureContour(Contour& c) {
  const std::vector<Vec2> at = positionsOf(c.points);
  c.lengthPx = polylineLength(at, c.closed);
  c.areaPx = c.closed ? polygonArea(at) : 0.0;
}

std::vector<Vec2> inkBeside(const Contour& c, int point) {
  const ContourPoint& here = c.points[point];
  if (!here.bundle || c.points.size() < 2) return {here.unrefined};
  const int before = std::max(point - 1, 0), after = std::min(point + 1, static_cast<int>(c.points.size()) - 1);
  const Vec2 along = c.points[after].unrefined - c.points[before].unrefined;
  if (!(along.norm() > 0.0)) return {here.unrefined};
  const Vec2 left = leftNormal(along.normalized());
  return {here.unrefined, here.unrefined + static_cast<double>(here.bundle->left) * left,
          here.unrefined - static_cast<double>(here.bundle->right) * left};
}

Vec2 placeOnInk(const Contour& c) {
  const int n = static_cast<int>(c.points.size()), middle = n / 2;
  const auto isBridge = [&](int i) {
    return std::any_of(c.bridges.begin(), c.bridges.end(),
                       [i](const auto& range) { return range.first <= i && i <= range.second; });
  };
  int best = middle;
  for (int i = 0, least = n + 1; i < n; ++i) {
    if (std::abs(i - middle) >= least || isBridge(i)) continue;
    least = std::abs(i - middle);
    best = i;
  }
  const std::vector<Vec2> places = inkBeside(c, best);
  if (places.size() == 1) return places[0];
  const BundleWidths bundle = c.points[best].bundle.value_or(BundleWidths{});
  return bundle.left >= bundle.right ? places[1] : places[2];
}

int bridgeCount(const ContourSet& set) {
  std::size_t count = 0;
  for (const Contour& contour : set.contours)
    count += contour.kind == ContourKind::Outline ? 0 : contour.bridges.size();
  return static_cast<int>(count);
}

int doubtfulCount(const ContourSet& set) {
  return static_cast<int>(
      std::ranges::count_if(set.junctions, [](const StrokeJunction& j) { return j.isDoubtful && !j.choice; }));
}

}  // namespace batten
