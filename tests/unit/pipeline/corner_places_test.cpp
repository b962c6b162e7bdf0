// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/corner_places.h"
#include "core/contour/corner/corner_suggestions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

ContourSet lineThrough(const std::vector<Vec2>& corners) {
  Contour contour;
  contour.kind = ContourKind::Outline;
  std::vector<Vec2> points;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 way = corners[i + 1] - corners[i];
    const int steps = static_cast<int>(way.norm());
    for (int k = 0; k < steps; ++k) points.push_back(corners[i] + way * k / steps);
  }
  points.push_back(corners.back());
  contour.points = contourPoints(points, true);
  ContourSet set;
  set.contours.push_back(std::move(contour));
  return set;
}

// A horse's ear: its sides are hardly longer than what is looked at, so that they hide each other.
TEST(CornerPlaces, TipsWithShortSidesAreSuggested) {
  const std::vector<Vec2> corners{{0, 100}, {150, 95}, {158, 78}, {163, 96}, {320, 100}};
  const auto found = suggestCornersAndCuts(lineThrough(corners), 35 * kDeg, 14.0, {});
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const auto near = std::count_if(found.begin(), found.end(), [&](const CornerSuggestion& s) {
      return (s.positionPx - corners[i]).norm() < 3.0;
    });
    EXPECT_EQ(near, 1) << corners[i].transpose();
  }
  EXPECT_EQ(found.size(), 3u);
}

TEST(CornerPlaces, AskedForSharperPlacesTheFitsCutsComeOnlyWhereTheyAreThatSharp) {
  const auto set = lineThrough({{0, 100}, {150, 95}, {158, 78}, {163, 96}, {320, 100}});
  for (const CornerSuggestion& s : suggestCornersAndCuts(set, 120 * kDeg, 14.0, {})) {
    EXPECT_NEAR(s.positionPx.x(), 158.0, 4.0);
  }
}

TEST(CornerPlaces, NoneOnSmoothLinesAndDots) {
  for (const double radius : {7.0, 9.0, 10.0, 20.0}) {
    Contour circle;
    circle.kind = ContourKind::Outline;
    circle.closed = true;
    const int count = static_cast<int>(2.0 * std::numbers::pi * radius);
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) {
      const double t = 2.0 * std::numbers::pi * i / count;
      points.emplace_back(50 + radius * std::cos(t), 50 + radius * std::sin(t));
    }
    circle.points = contourPoints(points, true);
    ContourSet set;
    set.contours.push_back(circle);
    EXPECT_TRUE(suggestCornersAndCuts(set, 35 * kDeg, 14.0, {}).empty()) << radius;
  }
}

}  // namespace
}  // namespace batten
