// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/stroke_fair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double kPi = 3.14159265358979323846;

double roughness(const std::vector<Vec2>& p) {
  double sum = 0.0;
  for (std::size_t i = 8; i + 8 < p.size(); ++i) sum += std::abs((p[i + 8] - 2.0 * p[i] + p[i - 8]).y());
  return sum;
}

TEST(StrokeFair, ASingleStrokeStaysWhereItIs) {
  std::vector<Vec2> points;
  for (int x = 0; x < 300; ++x) points.emplace_back(x, 4.0 * std::sin(0.1 * x));
  const std::vector<Vec2> before = points;
  fairWithinBand(points, false, std::vector<float>(points.size(), 0.0f), 100.0);
  EXPECT_EQ(points, before);
}

TEST(StrokeFair, WaverGoesAndTheLineStaysBetweenTheStrokes) {
  std::vector<Vec2> points;
  std::vector<float> band;
  for (int x = 0; x < 600; ++x) {
    const bool many = x > 200 && x < 400;
    points.emplace_back(x, many ? 3.0 * std::sin(0.15 * (x - 200)) : 0.0);
    band.push_back(many ? 6.0f : 0.0f);
  }
  const std::vector<Vec2> before = points;
  fairWithinBand(points, false, band, 120.0);
  EXPECT_LT(roughness(points), 0.15 * roughness(before));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE((points[i] - before[i]).norm(), 6.6);
    // The room fades beyond the ends of the strokes.
    if (i < 140 || i > 460) {
      EXPECT_EQ(points[i], before[i]);
    }
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
  fairWithinBand(points, true, std::vector<float>(points.size(), 5.0f), 100.0);
  for (const Vec2& p : points) EXPECT_NEAR(p.norm(), radius(std::atan2(p.y(), p.x())), 0.4);
}

TEST(StrokeFair, TinyAndOddThings) {
  std::vector<Vec2> none, two{{0, 0}, {1, 0}}, same(50, Vec2(3, 3));
  fairWithinBand(none, false, {}, 100.0);
  fairWithinBand(two, true, {4.0f, 4.0f}, 100.0);
  fairWithinBand(same, true, std::vector<float>(50, 4.0f), 100.0);
  std::vector<Vec2> wrongSize{{0, 0}, {1, 0}, {2, 0}};
  fairWithinBand(wrongSize, false, {9.0f}, 100.0);
  EXPECT_EQ(wrongSize[1], Vec2(1, 0));
  for (const Vec2& p : same) EXPECT_TRUE(p.allFinite());
  EXPECT_TRUE(two[0].allFinite() && two[1].allFinite());
}

}  // namespace
}  // namespace batten
