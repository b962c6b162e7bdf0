// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace batten {
namespace {

// A star, a wave drawn with a pen and a line that crosses both.
ContourSet drawing() {
  ContourSet set;
  const auto add = [&](const std::vector<Vec2>& points, ContourKind kind, bool closed) {
    Contour& contour = set.contours.emplace_back();
    contour.kind = kind;
    contour.closed = closed;
    contour.points = contourPoints(points, true);
    if (kind == ContourKind::Centreline)
      for (ContourPoint& p : contour.points) p.widthPx = 5.0f;
    if (kind == ContourKind::Pen)
      for (int i = 0; i < std::ssize(contour.points); ++i) contour.points[i].refined = i % 7 == 0;
    measureContour(contour);
  };
  std::vector<Vec2> star, wave, line;
  constexpr int kTips = 7, kStep = 60;
  const auto tip = [](int k) {
    const double a = 2.0 * 3.14159265358979 * k / (2 * kTips), r = k % 2 == 0 ? 140.0 : 70.0;
    return Vec2(200.0 + r * std::cos(a), 200.0 + r * std::sin(a));
  };
  for (int k = 0; k < 2 * kTips; ++k)
    for (int i = 0; i < kStep; ++i) star.push_back(tip(k) + (tip(k + 1) - tip(k)) * i / kStep);
  for (int i = 0; i < 400; ++i) wave.push_back({i, 120.0 + 30.0 * std::sin(0.05 * i)});
  for (int i = 0; i < 380; ++i) line.push_back({10.0 + i, 380.0 - 0.9 * i});
  add(star, ContourKind::Outline, true);
  add(wave, ContourKind::Pen, false);
  add(line, ContourKind::Centreline, false);
  return set;
}

TEST(CornerFinder, FindsTheSameWithAndWithoutSortedPoints) {
  const ContourSet set = drawing();
  CornerFinder sorted(set, 16.0);
  sorted.sortPoints();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-60.0, 460.0);
  int found = 0, turns = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec2 mark(place(random), place(random));
    const auto a = CornerFinder(set, 16.0).find(mark), b = sorted.find(mark);
    ASSERT_EQ(a.has_value(), b.has_value()) << mark.transpose();
    if (!a) continue;
    ++found;
    turns += std::abs(a->turningAngleRad) > 0.5 ? 1 : 0;
    EXPECT_EQ(a->contour, b->contour);
    EXPECT_EQ(a->pointIndex, b->pointIndex);
    EXPECT_EQ(a->snapPx, b->snapPx);
    EXPECT_EQ(a->turningAngleRad, b->turningAngleRad);
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(turns, 20);
  for (const double far : {1e12, -1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(sorted.find({far, 100.0}).has_value()) << far;
    EXPECT_FALSE(sorted.find({100.0, far}).has_value()) << far;
  }
  EXPECT_FALSE(CornerFinder(ContourSet{}, 16.0).find({0.0, 0.0}).has_value());
  CornerFinder empty(set, 16.0);
}

// The work for a mark does not grow with the marks before it: every point of a line is measured once.
TEST(CornerFinder, MeasuresAPointOnceHoweverManyMarksThereAre) {
  const ContourSet set = drawing();
  std::ptrdiff_t points = 0;
  for (const Contour& contour : set.contours) points += std::ssize(contour.points);
  CornerFinder finder(set, 16.0);
  finder.sortPoints();
  for (int i = 0; i < 20'000; ++i) finder.find({0.02 * i, 200.0 + 0.3 * (i % 600)});
  EXPECT_GT(finder.measuredPoints(), 100);
  EXPECT_LE(finder.measuredPoints(), points);
}

}  // namespace
}  // namespace batten
