// SPDX-License-Identifier: GPL-3.0-or-later
// Corners so close together that marks may mean either.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/corner/corner_suggestions.h"

namespace batten {
namespace {

/// A contour of exact points about a pixel apart through these corners.
ContourSet contourThrough(const std::vector<Vec2>& corners, bool closed) {
  Contour contour;
  contour.closed = closed;
  std::vector<Vec2> points;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < corners.size(); ++i) {
    const Vec2 side = corners[(i + 1) % corners.size()] - corners[i];
    const int count = static_cast<int>(std::lround(side.norm()));
    for (int k = 0; k < count; ++k) points.push_back(corners[i] + (static_cast<double>(k) / count) * side);
  }
  if (!closed) points.push_back(corners.back());
  contour.points = contourPoints(points, true);
  ContourSet set;
  set.contours.push_back(contour);
  return set;
}

// Two feet that nearly touch: a mark on a corner of the blunt one finds the tip of the other across the gap.
TEST(SuggestCorners, AMarkAtEverySuggestionFindsACornerOfItsOwn) {
  const ContourSet set = contourThrough({{291.5, 310.4},
                                         {272.8, 311.7},
                                         {265.8, 295.4},
                                         {261.7, 249.6},
                                         {269.3, 307.7},
                                         {250.8, 308.6},
                                         {244.6, 292.3},
                                         {249, 189},
                                         {294, 183}},
                                        true);
  const double angle = 35.0 * std::numbers::pi / 180.0, scale = 14.0;
  const auto marksAt = [](const std::vector<CornerSuggestion>& suggestions) {
    std::vector<CornerMark> marks;
    for (const CornerSuggestion& s : suggestions) marks.push_back({s.positionPx});
    return marks;
  };
  const auto all = suggestCorners(set, angle, scale, {}), offered = oncePerCorner(set, all, 16.0, {});
  const auto asked = splitAtCorners(set, marksAt(all), {}, {});
  ASSERT_FALSE(asked->sameCorner.empty()) << "else this drawing shows nothing";
  const auto made = splitAtCorners(set, marksAt(offered), {}, {});
  EXPECT_EQ(made->corners.size(), offered.size());
  EXPECT_EQ(made->corners.size(), asked->corners.size()) << "none is lost either";
  EXPECT_TRUE(made->sameCorner.empty());
  EXPECT_TRUE(made->lostMarks.empty());
}

TEST(CornerMarks, CornersThatLeaveASliverAreNamed) {
  const ContourSet open = contourThrough({{0, 100}, {300, 100}}, false);
  const auto pieces =
      splitAtCorners(open, std::vector<CornerMark>{{Vec2(154, 101)}, {Vec2(50, 100)}, {Vec2(150, 100)}}, {}, {});
  ASSERT_EQ(pieces->corners.size(), 3u);
  ASSERT_EQ(pieces->closeCorners.size(), 1u);
  EXPECT_EQ(pieces->closeCorners[0].mark, 2);
  EXPECT_EQ(pieces->closeCorners[0].other, 0);
  EXPECT_NEAR(pieces->closeCorners[0].apartPx, 4.0, 0.6);
  const ContourSet ring = contourThrough({{50, 50}, {350, 50}, {350, 250}, {50, 250}}, true);
  const std::vector<Vec2> points = positionsOf(ring.contours[0].points);
  const auto two = splitAtCorners(ring, std::vector<CornerMark>{{points[160]}, {points[164]}}, {}, {});
  ASSERT_EQ(two->corners.size(), 2u);
  EXPECT_EQ(two->closeCorners.size(), 1u);
}

/// Points beyond a corner that were laid through a junction, about a pixel apart along `beyond`, with measured ones
/// before the corner and after them.
ContourSet laidBeyondACorner(const std::vector<Vec2>& beyond) {
  ContourSet set = contourThrough({{60, 100}, beyond.front()}, false);
  std::vector<ContourPoint>& points = set.contours[0].points;
  for (const ContourPoint& p : contourPoints(beyond, false)) points.push_back(p);
  std::vector<Vec2> on;
  const Vec2 along = (beyond.back() - beyond[beyond.size() - 2]).normalized();
  for (int k = 1; k <= 40; ++k) on.push_back(beyond.back() + k * along);
  for (const ContourPoint& p : contourPoints(on, true)) points.push_back(p);
  for (ContourPoint& p : points) p.widthPx = 4.0f;
  return set;
}

// Beside a corner of two strokes such points round the turn; a bow that they go round is the line's own.
TEST(CornerMarks, WhatWasLaidBesideACornerStaysWhereTheLineBends) {
  constexpr double kRadius = 12.0;
  const Vec2 corner(140, 100);
  std::vector<Vec2> bow, straight;
  for (int k = 0; k <= 22; ++k) {
    const double angle = k / kRadius;
    bow.push_back(corner + kRadius * Vec2(std::cos(angle) - 1.0, -std::sin(angle)));
    straight.push_back(corner + Vec2(0.0, -1.0 * k));
  }
  const auto nearestTo = [&](const std::vector<Vec2>& beyond) {
    const ContourSet set = laidBeyondACorner(beyond);
    const auto pieces = splitAtCorners(set, std::vector<CornerMark>{{corner}}, {}, {});
    EXPECT_TRUE(pieces && pieces->pieces.size() == 2u);
    double nearest = 1e9;
    if (!pieces || pieces->pieces.size() != 2u) return nearest;
    for (const PiecePoint& p : pieces->pieces[1].points) nearest = std::min(nearest, (p.at - beyond[7]).norm());
    return nearest;
  };
  EXPECT_LT(nearestTo(bow), 1.0);
  EXPECT_GT(nearestTo(straight), 3.0);
}

}  // namespace
}  // namespace batten
