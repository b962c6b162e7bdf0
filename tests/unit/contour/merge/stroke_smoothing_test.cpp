// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/angles.h"

namespace batten {
namespace {

using test::kPi;

double roughness(const std::vector<Vec2>& p) {
  double sum = 0.0;
  for (std::size_t i = 8; i + 8 < p.size(); ++i) sum += std::abs((p[i + 8] - 2.0 * p[i] + p[i - 8]).y());
  return sum;
}

std::vector<BundleWidths> evenBundle(std::size_t count, float px) { return std::vector<BundleWidths>(count, {px, px}); }

TEST(StrokeFair, ASingleStrokeStaysWhereItIs) {
  std::vector<Vec2> points;
  for (int x = 0; x < 300; ++x) points.emplace_back(x, 4.0 * std::sin(0.1 * x));
  const std::vector<Vec2> before = points;
  points = fairWithinBundle(points, false, evenBundle(points.size(), 0.0f), 100.0);
  EXPECT_EQ(points, before);
}

TEST(StrokeFair, WaverGoesAndTheLineStaysBetweenTheStrokes) {
  std::vector<Vec2> points;
  std::vector<BundleWidths> bundle;
  for (int x = 0; x < 600; ++x) {
    const bool many = x > 200 && x < 400;
    points.emplace_back(x, many ? 3.0 * std::sin(0.15 * (x - 200)) : 0.0);
    bundle.push_back(many ? BundleWidths{6.0f, 6.0f} : BundleWidths{});
  }
  const std::vector<Vec2> before = points;
  points = fairWithinBundle(points, false, bundle, 120.0);
  EXPECT_LT(roughness(points), 0.15 * roughness(before));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE((points[i] - before[i]).norm(), 6.0);
    // The room fades beyond the ends of the strokes.
    if (i < 140 || i > 460) {
      EXPECT_EQ(points[i], before[i]);
    }
  }
}

// The strokes: the line moved along its own normals, by much to one side and by little to the other.
TEST(StrokeFair, ALineThatIsNotInTheMiddleStaysBetweenTheStrokesToo) {
  const auto wave = [](double x) { return 3.0 * std::sin(0.15 * x); };
  const auto crossedAt = [&](double x, double offset) {
    double from = x - 10.0, to = x + 10.0;  // of the line, where the moved one crosses x
    for (int i = 0; i < 60; ++i) {
      const double mid = 0.5 * (from + to), slope = 0.45 * std::cos(0.15 * mid);
      (mid - offset * slope / std::hypot(1.0, slope) < x ? from : to) = mid;
    }
    return wave(from) + offset / std::hypot(1.0, 0.45 * std::cos(0.15 * from));
  };
  for (const auto& [left, right] : {std::pair(5.0, 0.5), std::pair(0.5, 5.0), std::pair(5.0, 0.0)}) {
    std::vector<Vec2> points;
    for (int x = 0; x < 500; ++x) points.emplace_back(x, wave(x));
    const std::vector<Vec2> before = points;
    const std::vector<BundleWidths> bundle(500, {static_cast<float>(left), static_cast<float>(right)});
    points = fairWithinBundle(points, false, bundle, 200.0);
    EXPECT_LT(roughness(points), (right + left < 5.2 ? 0.8 : 0.5) * roughness(before));
    for (std::size_t i = 10; i + 10 < points.size(); ++i) {
      EXPECT_LE(points[i].y(), crossedAt(points[i].x(), left) + 0.05) << i;
      EXPECT_GE(points[i].y(), crossedAt(points[i].x(), -right) - 0.05) << i;
    }
  }
}

TEST(StrokeFair, CornersAndSmallRingsMoveNoFartherThanThereIsRoom) {
  for (const double room : {0.5, 0.6, 1.0, 3.0}) {
    std::vector<Vec2> corner, ring;
    for (int i = 0; i <= 200; ++i) corner.emplace_back(i, 0.0);
    for (int i = 1; i <= 200; ++i) corner.emplace_back(200.0, i);
    for (int i = 0; i < 37; ++i)
      ring.emplace_back(6.0 * std::cos(2.0 * kPi * i / 37), 6.0 * std::sin(2.0 * kPi * i / 37));
    const std::vector<Vec2> before = corner;
    corner = fairWithinBundle(corner, false, evenBundle(corner.size(), static_cast<float>(room)), 60.0);
    ring = fairWithinBundle(ring, true, evenBundle(ring.size(), static_cast<float>(room)), 60.0);
    for (std::size_t i = 0; i < corner.size(); ++i) EXPECT_LE((corner[i] - before[i]).norm(), room);
    for (const Vec2& p : ring) EXPECT_NEAR(p.norm(), 6.0, room);
  }
}

TEST(StrokeFair, LongWavesStayAndRingsHaveNoSeam) {
  std::vector<Vec2> points;
  const int n = 1000;
  const auto radius = [](double a) { return 160.0 + 12.0 * std::cos(2.0 * a); };
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * kPi * i / n;
    points.push_back((radius(a) + 1.5 * std::sin(40.0 * a)) * Vec2(std::cos(a), std::sin(a)));
  }
  points = fairWithinBundle(points, true, evenBundle(points.size(), 5.0f), 100.0);
  for (const Vec2& p : points) EXPECT_NEAR(p.norm(), radius(std::atan2(p.y(), p.x())), 0.4);
}

TEST(StrokeFair, TinyAndOddThings) {
  std::vector<Vec2> none, two{{0, 0}, {1, 0}}, same(50, Vec2(3, 3));
  none = fairWithinBundle(none, false, {}, 100.0);
  two = fairWithinBundle(two, true, evenBundle(2, 4.0f), 100.0);
  same = fairWithinBundle(same, true, evenBundle(50, 4.0f), 100.0);
  std::vector<Vec2> wrongSize{{0, 0}, {1, 0}, {2, 0}};
  wrongSize = fairWithinBundle(wrongSize, false, evenBundle(1, 9.0f), 100.0);
  EXPECT_EQ(wrongSize[1], Vec2(1, 0));
  for (const Vec2& p : same) EXPECT_TRUE(p.allFinite());
  EXPECT_TRUE(two[0].allFinite() && two[1].allFinite());
}

}  // namespace
}  // namespace batten
