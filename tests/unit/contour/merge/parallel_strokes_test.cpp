// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/parallel_strokes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/polyline/polyline_tools.h"
#include "tests/support/angles.h"

namespace batten {
namespace {

using test::kPi;
constexpr double kPenPx = 3.0;

Contour besideLine(std::vector<Vec2> points, bool closed = false) {
  Contour c;
  c.kind = ContourKind::Centreline;
  c.closed = closed;
  c.lengthPx = polylineLength(points, closed);
  c.points = contourPoints(points, true);
  return c;
}

Contour graphOf(const std::function<double(double)>& y, int from, int to) {
  std::vector<Vec2> points;
  for (int x = from; x <= to; ++x) points.emplace_back(x, y(x));
  return besideLine(std::move(points));
}

Contour level(double y, int from, int to) {
  return graphOf([y](double) { return y; }, from, to);
}

Contour ring(double radius) {
  const int count = static_cast<int>(2.0 * kPi * radius);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(300.0 + radius * std::cos(2.0 * kPi * i / count),
                        300.0 + radius * std::sin(2.0 * kPi * i / count));
  return besideLine(std::move(points), true);
}

TEST(ParallelStretch, AStrokeThatTakesOverFromAnother) {
  const auto found = findParallelStrokes({level(100, 0, 300), level(120, 100, 400)}, kPenPx, 60.0, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].line, 0);
  EXPECT_EQ(found[0].begin, SideEnd::OtherEnd);
  EXPECT_EQ(found[0].end, SideEnd::OwnEnd);
  EXPECT_EQ(found[1].begin, SideEnd::OwnEnd);
  EXPECT_EQ(found[1].end, SideEnd::OtherEnd);
  for (const ParallelStretch& s : found) {
    EXPECT_NEAR(s.lengthPx(), 200.0, 2.0 * s.stepPx);
    EXPECT_DOUBLE_EQ(s.widestPx, 20.0);
  }
}

TEST(ParallelStretch, StrokesOfAHatchingEndLevel) {
  // An end is level with another when it is no farther along than the two are apart, or about so.
  const auto found =
      findParallelStrokes({level(100, 0, 300), level(112, 7, 290), level(124, 3, 305)}, kPenPx, 60.0, {});
  int whole = 0;
  for (const ParallelStretch& s : found) {
    if (s.lengthPx() < 30.0) continue;  // beyond the end of one lies the next but one
    ++whole;
    EXPECT_EQ(s.begin, SideEnd::LevelEnds);
    EXPECT_EQ(s.end, SideEnd::LevelEnds);
    EXPECT_DOUBLE_EQ(s.widestPx, 12.0);
  }
  EXPECT_EQ(whole, 4);
}

TEST(ParallelStretch, RingsNeverEnd) {
  const auto found = findParallelStrokes({ring(200.0), ring(215.0)}, kPenPx, 60.0, {});
  ASSERT_EQ(found.size(), 2u);
  for (const ParallelStretch& s : found) {
    EXPECT_EQ(s.begin, SideEnd::Never);
    EXPECT_EQ(s.end, SideEnd::Never);
    EXPECT_NEAR(s.widestPx, 15.0, 0.1);
  }
}

// Two strokes that cross at x = 0, 200, … and are up to 24 px apart in between.
TEST(ParallelStretch, StrokesThatCrossAtASmallAngleMeet) {
  const auto wave = [](double sign) {
    return [sign](double x) { return 300.0 + sign * 12.0 * std::sin(kPi * x / 200.0); };
  };
  const auto found =
      findParallelStrokes({graphOf(wave(1.0), -100, 900), graphOf(wave(-1.0), -100, 900)}, kPenPx, 60.0, {});
  int between = 0;
  for (const ParallelStretch& s : found) {
    if (s.begin != SideEnd::Meets || s.end != SideEnd::Meets) continue;
    ++between;
    EXPECT_NEAR(s.widestPx, 24.0, 0.5);
    EXPECT_NEAR(s.lengthPx(), 200.0, 12.0);
  }
  EXPECT_EQ(between, 8);
}

TEST(ParallelStretch, LinesThatGoTheirWaysPart) {
  const auto fork = graphOf([](double x) { return 110.0 + 0.002 * x * x; }, 0, 300);
  const auto found = findParallelStrokes({level(100, 0, 300), fork}, kPenPx, 40.0, {});
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].line, 0);
  EXPECT_EQ(found[0].begin, SideEnd::LevelEnds);
  EXPECT_EQ(found[0].end, SideEnd::Parts);
}

TEST(ParallelStretch, LinesBetweenTwoOthersAreCut) {
  std::vector<Vec2> left, right;
  for (int y = 0; y <= 220; ++y) {
    left.emplace_back(-1.0, y);
    right.emplace_back(301.0, y);
  }
  const auto found = findParallelStrokes({level(100, 0, 300), level(120, 0, 300), besideLine(left), besideLine(right)},
                                         kPenPx, 60.0, {});
  ASSERT_EQ(found.size(), 2u);
  for (const ParallelStretch& s : found) {
    EXPECT_EQ(s.begin, SideEnd::Cut);
    EXPECT_EQ(s.end, SideEnd::Cut);
  }
}

// Where a line lies beside itself, as a spiral does; not where it merely turns.
TEST(ParallelStretch, ALineBesideItself) {
  std::vector<Vec2> spiral;
  for (double a = 0.0; a < 4.0 * kPi;) {
    const double r = 100.0 + 20.0 * a / (2.0 * kPi);
    spiral.emplace_back(300.0 + r * std::cos(a), 300.0 + r * std::sin(a));
    a += 1.0 / r;
  }
  const auto found = findParallelStrokes({besideLine(spiral)}, kPenPx, 60.0, {});
  ASSERT_EQ(found.size(), 2u);
  for (const ParallelStretch& s : found) EXPECT_NEAR(s.widestPx, 20.0, 0.3);
  EXPECT_TRUE(findParallelStrokes({ring(30.0)}, kPenPx, 200.0, {}).empty());
}

TEST(ParallelStretch, AHairpin) {
  std::vector<Vec2> points;
  for (int x = 0; x <= 300; ++x) points.emplace_back(x, 100.0);
  for (double a = -0.5 * kPi; a < 0.5 * kPi; a += 0.1)
    points.emplace_back(300 + 10 * std::cos(a), 110 + 10 * std::sin(a));
  for (int x = 300; x >= 50; --x) points.emplace_back(x, 120.0);
  const auto found = findParallelStrokes({besideLine(points)}, kPenPx, 60.0, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].begin, SideEnd::OtherEnd);
  EXPECT_EQ(found[0].end, SideEnd::Tip);
  EXPECT_EQ(found[1].begin, SideEnd::Tip);
  EXPECT_EQ(found[1].end, SideEnd::OwnEnd);
}

TEST(ParallelStretch, SameWithAnyNumberOfThreads) {
  const std::vector<Contour> lines{graphOf([](double x) { return 300.0 + 9.0 * std::sin(0.02 * x); }, 0, 900),
                                   graphOf([](double x) { return 303.0 + 9.0 * std::cos(0.025 * x); }, 40, 700),
                                   level(320, 100, 800), ring(100.0)};
  RunContext one, five;
  one.threads = 1;
  five.threads = 5;
  const auto a = findParallelStrokes(lines, kPenPx, 60.0, one), b = findParallelStrokes(lines, kPenPx, 60.0, five);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].line, b[i].line);
    EXPECT_EQ(a[i].begin, b[i].begin);
    EXPECT_EQ(a[i].end, b[i].end);
    EXPECT_EQ(a[i].apartPx, b[i].apartPx);
  }
}

TEST(ParallelStretch, NothingToLookAt) {
  EXPECT_TRUE(findParallelStrokes({}, kPenPx, 60.0, {}).empty());
  EXPECT_TRUE(findParallelStrokes({level(100, 0, 300), level(110, 0, 300)}, 0.0, 60.0, {}).empty());
  RunContext stopped;
  stopped.cancel.cancel();
  EXPECT_TRUE(findParallelStrokes({level(100, 0, 300), level(110, 0, 300)}, kPenPx, 60.0, stopped).empty());
}

}  // namespace
}  // namespace batten
