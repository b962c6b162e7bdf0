// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/polyline/polyline_tools.h"
#include "tests/support/angles.h"

namespace batten {
namespace {

using test::kPi;

Contour strokeOf(std::vector<Vec2> points, bool closed = false) {
  Contour c;
  c.kind = ContourKind::Centreline;
  c.closed = closed;
  c.points = contourPoints(points, true);
  for (ContourPoint& p : c.points) p.widthPx = 3.0f;
  c.lengthPx = polylineLength(points, closed);
  return c;
}

Contour arc(const Vec2& centre, double radius, double from, double to) {
  std::vector<Vec2> points;
  const int n = static_cast<int>(std::abs(to - from) * radius);
  for (int i = 0; i <= n; ++i) {
    const double a = from + (to - from) * i / n;
    points.push_back(centre + radius * Vec2(std::cos(a), std::sin(a)));
  }
  return strokeOf(std::move(points));
}

Contour line(const Vec2& a, const Vec2& b) {
  std::vector<Vec2> points;
  const int n = static_cast<int>((b - a).norm());
  for (int i = 0; i <= n; ++i) points.push_back(a + (b - a) * (static_cast<double>(i) / n));
  return strokeOf(std::move(points));
}

TEST(StrokeMerge, ParallelStrokesBecomeTheirMean) {
  const std::vector<Contour> strokes{line({40, 97}, {360, 97}), line({360, 104}, {40, 104}),
                                     line({40, 110}, {360, 110})};
  const auto merged = mergeStrokes(strokes, 12.0, {});
  ASSERT_EQ(merged.size(), 1u);
  for (std::size_t i = 0; i < merged[0].points.size(); ++i) {
    if (merged[0].points[i].at.x() < 70 || merged[0].points[i].at.x() > 330) continue;
    EXPECT_NEAR(merged[0].points[i].at.y(), 311.0 / 3.0, 0.25);
    const double y = merged[0].points[i].at.y();
    // Which side is left depends on the way the line runs.
    const auto [low, high] =
        std::minmax(merged[0].points[i].bundle.value().left, merged[0].points[i].bundle.value().right);
    EXPECT_NEAR(low, 110.0 - y, 0.3);
    EXPECT_NEAR(high, y - 97.0, 0.3);
  }
}

// Where one stroke ends and the next begins, the mean goes over without a step.
TEST(StrokeMerge, OverlappingStrokesAreOneSmoothLine) {
  const std::vector<Contour> strokes{line({0, 100}, {240, 100}), line({160, 106}, {400, 106})};
  const auto merged = mergeStrokes(strokes, 12.0, {});
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_NEAR(merged[0].lengthPx, 400.0, 4.0);
  for (const Vec2& p : positionsOf(merged[0].points)) {
    EXPECT_GE(p.y(), 99.9);
    EXPECT_LE(p.y(), 106.1);
    if (p.x() < 120) {
      EXPECT_NEAR(p.y(), 100.0, 0.05);
    }
    if (p.x() > 280) {
      EXPECT_NEAR(p.y(), 106.0, 0.05);
    }
  }
  // From the one stroke to the mean and from there to the other: two slopes, each begun and ended by one bend.
  std::vector<double> angle;
  for (const Vec2& d : directions(positionsOf(merged[0].points), false, 6)) angle.push_back(std::atan(d.y() / d.x()));
  double turning = 0.0, steepest = 0.0;
  for (std::size_t i = 0; i < angle.size(); ++i) {
    if (i > 0) turning += std::abs(angle[i] - angle[i - 1]);
    steepest = std::max(steepest, std::abs(angle[i]));
  }
  EXPECT_LT(steepest, 0.12);
  EXPECT_LT(turning, 3.3 * steepest);
}

// A gap in the ink that a stroke bridges stays marked on the line that it is merged into, where that line runs along
// it.
TEST(StrokeMerge, BridgesStayMarked) {
  std::vector<Contour> strokes{line({0, 100}, {240, 100}), line({160, 106}, {400, 106})};
  strokes[0].bridges = {{60, 80}};
  strokes[1].bridges = {{200, 210}};
  const auto merged = mergeStrokes(strokes, 12.0, {});
  ASSERT_EQ(merged.size(), 1u);
  ASSERT_EQ(merged[0].bridges.size(), 2u);
  std::vector<std::pair<double, double>> places;
  for (const auto& [first, last] : merged[0].bridges) {
    places.push_back(std::minmax(merged[0].points[first].at.x(), merged[0].points[last].at.x()));
  }
  std::sort(places.begin(), places.end());
  EXPECT_NEAR(places[0].first, 60.0, 2.0);
  EXPECT_NEAR(places[0].second, 80.0, 2.0);
  EXPECT_NEAR(places[1].first, 360.0, 2.0);
  EXPECT_NEAR(places[1].second, 370.0, 2.0);
}

TEST(StrokeMerge, ALoopOfSeveralStrokesIsClosed) {
  const Vec2 c(200, 200);
  const std::vector<Contour> strokes{arc(c, 120, 0.0, 2.4), arc(c, 124, 4.5, 2.1), arc(c, 121, 4.2, 2 * kPi + 0.3)};
  const auto merged = mergeStrokes(strokes, 14.0, {});
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_TRUE(merged[0].closed);
  for (std::size_t i = 0; i < merged[0].points.size(); ++i) {
    EXPECT_NEAR((merged[0].points[i].at - c).norm(), 122.0, 2.6);
    EXPECT_LE(std::max(merged[0].points[i].bundle.value().left, merged[0].points[i].bundle.value().right), 4.3f);
    EXPECT_GE(std::min(merged[0].points[i].bundle.value().left, merged[0].points[i].bundle.value().right), 0.0f);
  }
}

Contour wave(double y, double amplitude, int from, int to) {
  std::vector<Vec2> points;
  for (int x = from; x <= to; ++x) points.emplace_back(x, y + amplitude * std::sin(0.15 * x));
  return strokeOf(std::move(points));
}

// Several strokes to one side and one to the other: the mean is near the many.
TEST(StrokeMerge, TheLineStaysBetweenStrokesThatLieUnevenly) {
  for (const double amplitude : {0.0, 2.0, 4.0}) {
    const std::vector<Contour> strokes{wave(100.0, amplitude, 0, 600), wave(100.4, amplitude, 0, 600),
                                       wave(99.6, amplitude, 0, 600), wave(110.0, 0.0, 100, 500)};
    const auto merged = mergeStrokes(strokes, 15.0, {});
    ASSERT_EQ(merged.size(), 1u);
    for (const Vec2& p : positionsOf(merged[0].points)) {
      if (p.x() < 100 || p.x() > 500) continue;
      const double waver = amplitude * std::sin(0.15 * p.x());
      EXPECT_GE(p.y(), std::min(99.6 + waver, 110.0) - 0.3) << p.x();
      EXPECT_LE(p.y(), std::max(100.4 + waver, 110.0) + 0.3) << p.x();
    }
  }
}

TEST(StrokeMerge, TheBundleHoldsEveryStroke) {
  const std::vector<std::vector<Contour>> bundles{
      {wave(100.0, 0.0, 0, 600), wave(100.5, 0.0, 0, 600), wave(99.5, 0.0, 0, 600), wave(110.0, 0.0, 0, 600)},
      {wave(100.0, 3.0, 0, 600), wave(104.0, 0.0, 0, 600), wave(108.0, -3.0, 150, 450)},
      {arc({300, 300}, 150, 0.2, 2.8), arc({300, 300}, 151, 2.7, 0.3), arc({303, 300}, 158, 0.8, 2.2)}};
  for (const auto& strokes : bundles) {
    const auto merged = mergeStrokes(strokes, 15.0, {});
    ASSERT_EQ(merged.size(), 1u);
    const Contour& c = merged[0];
    const std::vector<Vec2> tangent = directions(positionsOf(c.points), c.closed, 3);
    for (const Contour& stroke : strokes) {
      for (const Vec2& p : positionsOf(stroke.points)) {
        std::size_t at = 0;
        for (std::size_t i = 0; i < c.points.size(); ++i)
          if ((c.points[i].at - p).norm() < (c.points[at].at - p).norm()) at = i;
        if (at < 20 || at + 20 >= c.points.size()) continue;
        const double offset = (p - c.points[at].at).dot(leftNormal(tangent[at]));
        EXPECT_LE(offset, c.points[at].bundle.value().left + 0.6) << p.transpose();
        EXPECT_GE(offset, -c.points[at].bundle.value().right - 0.6) << p.transpose();
      }
    }
    // Nor is it wider than the strokes lie apart.
    float left = 0.0f, right = 0.0f;
    for (const ContourPoint& p : c.points) {
      left = std::max(left, p.bundle.value().left);
      right = std::max(right, p.bundle.value().right);
    }
    EXPECT_LE(left + right, 22.0f);
  }
}

// Two strokes around a corner: what is between them is little, and the line rounds the corner by no more.
TEST(StrokeMerge, CornersStaySharp) {
  for (const double apart : {2.0, 4.0, 8.0}) {
    std::vector<Contour> strokes;
    for (const double offset : {-0.5 * apart, 0.5 * apart}) {
      std::vector<Vec2> points;
      for (double x = 0.0; x < 200.0 + offset; ++x) points.emplace_back(x, -offset);
      for (double y = -offset; y < 200.0; ++y) points.emplace_back(200.0 + offset, y);
      strokes.push_back(strokeOf(std::move(points)));
    }
    const auto merged = mergeStrokes(strokes, apart + 6.0, {});
    ASSERT_FALSE(merged.empty());
    double missed = std::numeric_limits<double>::infinity();
    for (const Vec2& p : positionsOf(merged[0].points)) missed = std::min(missed, (p - Vec2(200.0, 0.0)).norm());
    EXPECT_LE(missed, 0.5 * apart + 0.5);
  }
}

// A loop drawn in strokes that begin and end beside each other, or leave a gap.
TEST(StrokeMerge, AJoinedLineHasAPointAPixel) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int closed = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double distance = 8.0 + 40.0 * unit(random), radius = 100.0 + 80.0 * unit(random);
    const int count = 2 + static_cast<int>(4.0 * unit(random));
    double begin = 2.0 * kPi * unit(random);
    std::vector<Contour> strokes;
    for (int k = 0; k < count; ++k) {
      const double span = 2.0 * kPi / count + (1.2 * unit(random) - 0.6) * distance / radius;
      const double from = radius + 0.8 * distance * (unit(random) - 0.5),
                   to = radius + 0.8 * distance * (unit(random) - 0.5);
      std::vector<Vec2> points;
      const int n = static_cast<int>(span * radius);
      for (int i = 0; i <= n; ++i) {
        const double part = static_cast<double>(i) / n, angle = begin + span * part;
        points.push_back(std::lerp(from, to, part) * Vec2(std::cos(angle), std::sin(angle)));
      }
      strokes.push_back(strokeOf(std::move(points)));
      begin += 2.0 * kPi / count;
    }
    for (const Contour& c : mergeStrokes(strokes, distance, {})) {
      closed += c.closed ? 1 : 0;
      ASSERT_EQ(strokeWidthsOf(c.points).size(), c.points.size());
      for (std::size_t i = c.closed ? 0 : 1; i < c.points.size(); ++i) {
        const Vec2& before = c.points[i > 0 ? i - 1 : c.points.size() - 1].at;
        EXPECT_LE((c.points[i].at - before).norm(), 1.8)
            << "trial " << trial << " point " << i << " closed " << c.closed;
      }
    }
  }
  EXPECT_GE(closed, 15);
}

TEST(StrokeMerge, CrossingsAndLonelyLinesStayAsTheyAre) {
  const std::vector<Contour> lines{line({20, 20}, {300, 300}), line({20, 300}, {300, 20}), line({20, 400}, {300, 400}),
                                   line({20, 430}, {300, 430})};
  const auto merged = mergeStrokes(lines, 20.0, {});
  ASSERT_EQ(merged.size(), lines.size());
  for (const Contour& c : merged) {
    const bool known = std::any_of(lines.begin(), lines.end(),
                                   [&](const Contour& l) { return positionsOf(l.points) == positionsOf(c.points); });
    EXPECT_TRUE(known);
    for (const ContourPoint& p : c.points) EXPECT_TRUE(p.bundle == BundleWidths{});
  }
}

TEST(StrokeMerge, OvershootsGoAndLongBranchesStay) {
  // A second stroke runs along the first and turns away: 25 px, then 150 px beyond where it leaves.
  const auto turning = [](double length) {
    std::vector<Vec2> points;
    for (int x = 60; x <= 200; ++x) points.emplace_back(x, 103.0);
    Vec2 p = points.back();
    for (double s = 0.0; s < length; s += 1.0) {
      const double angle = std::min(1.0, s / 30.0);
      p += Vec2(std::cos(angle), std::sin(angle));
      points.push_back(p);
    }
    return strokeOf(std::move(points));
  };
  const std::vector<Contour> shortOne{line({0, 100}, {400, 100}), turning(25.0)};
  EXPECT_EQ(mergeStrokes(shortOne, 14.0, {}).size(), 1u);
  const std::vector<Contour> longOne{line({0, 100}, {400, 100}), turning(150.0)};
  EXPECT_EQ(mergeStrokes(longOne, 14.0, {}).size(), 2u);
}

TEST(StrokeMerge, SameResultWithAnyNumberOfThreads) {
  std::vector<Contour> strokes;
  for (int i = 0; i < 12; ++i) strokes.push_back(arc({200, 200}, 100.0 + 3.0 * i, 0.2 * i, 0.2 * i + 2.5));
  RunContext one, five;
  one.threads = 1;
  five.threads = 5;
  const auto a = mergeStrokes(strokes, 9.0, one), b = mergeStrokes(strokes, 9.0, five);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(a[i].points == b[i].points);
    for (const ContourPoint& p : a[i].points) EXPECT_TRUE(p.at.allFinite());
  }
}

TEST(StrokeMerge, NothingAndTinyThings) {
  EXPECT_TRUE(mergeStrokes({}, 10.0, {}).empty());
  const std::vector<Contour> tiny{strokeOf({{1, 1}, {2, 1}}), strokeOf({{5, 5}, {5, 5}, {5, 5}}),
                                  line({0, 50}, {90, 50})};
  EXPECT_GE(mergeStrokes(tiny, 10.0, {}).size(), 1u);
  RunContext cancelled;
  cancelled.cancel.cancel();
  EXPECT_TRUE(mergeStrokes(tiny, 10.0, cancelled).empty());
}

}  // namespace
}  // namespace batten
