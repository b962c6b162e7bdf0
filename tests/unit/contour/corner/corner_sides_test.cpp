// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace batten {
namespace {

// An open contour along y(x), points about 1 px apart, from x = 0 on, with noise across.
Contour sideOf(const std::function<double(double)>& y, double length, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss(0.0, 1.0);
  std::vector<Vec2> points;
  for (double x = 0.0; x <= length;) {
    points.emplace_back(x, y(x) + noise * gauss(random));
    const double slope = (y(x + 1e-3) - y(x)) / 1e-3;
    x += 1.0 / std::sqrt(1.0 + slope * slope);
  }
  Contour c;
  c.points = contourPoints(points, true);
  return c;
}

// Where the extended side crosses x = 0.
double heightAtZero(const CornerSide& side) {
  double x = 0.0;
  for (int step = 0; step < 20; ++step) x -= side.at(x).x() / side.derivative(x).x();
  return side.at(x).y();
}

// Noise-free points still count as good to what the pixel grid leaves, .02 px over 16 px.
TEST(CornerSides, PolynomialsAreExtendedWithinTheNoiseOfTheGrid) {
  const std::function<double(double)> courses[] = {
      [](double x) { return 100.0 + 0.3 * x; },
      [](double x) { return 100.0 - 0.1 * x + 0.002 * x * x; },
  };
  for (const auto& y : courses) {
    const auto fitted = fitCornerSide(sideOf(y, 120.0, 0.0, 1), 0, 1, 4.0, 110.0);
    ASSERT_TRUE(fitted);
    const CornerSide& side = *fitted;
    EXPECT_NEAR(heightAtZero(side), y(0.0), 0.06);
    EXPECT_LE(std::abs(heightAtZero(side) - y(0.0)), 2.5 * side.sigmaPx);
    EXPECT_GT(side.to - side.from, 20.0);
  }
}

// The error of the extension is what the fit says it is, and falls with the length of the side.
TEST(CornerSides, NoiseIsAveragedOverLongSides) {
  const auto arc = [](double x) { return 100.0 + 300.0 - std::sqrt(300.0 * 300.0 - x * x); };
  double shortSquare = 0.0, longSquare = 0.0, said = 0.0;
  constexpr int kRuns = 60;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const Contour contour = sideOf(arc, 200.0, 0.1, seed);
    const CornerSide nearBy = fitCornerSide(contour, 0, 1, 4.0, 30.0).value();
    const CornerSide far = fitCornerSide(contour, 0, 1, 4.0, 190.0).value();
    shortSquare += std::pow(heightAtZero(nearBy) - 100.0, 2) / kRuns;
    longSquare += std::pow(heightAtZero(far) - 100.0, 2) / kRuns;
    said += far.sigmaPx * far.sigmaPx / kRuns;
  }
  EXPECT_LT(std::sqrt(longSquare), 0.5 * std::sqrt(shortSquare));
  EXPECT_LT(std::sqrt(longSquare), 0.08);
  EXPECT_NEAR(std::sqrt(longSquare / said), 1.4, 0.8);  // the choice itself follows the noise
}

// A line that goes over into an arc 40 px away must not be taken for one parabola.
TEST(CornerSides, StopsWhereTheCourseChanges) {
  const auto bent = [](double x) { return x < 40.0 ? 100.0 : 100.0 + 0.5 * (x - 40.0) * (x - 40.0) / 60.0; };
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const CornerSide side = fitCornerSide(sideOf(bent, 90.0, 0.08, seed), 0, 1, 4.0, 85.0).value();
    EXPECT_NEAR(heightAtZero(side), 100.0, 0.3) << seed;
  }
}

TEST(CornerSides, TooFewPointsGiveNoFit) {
  const Contour contour = sideOf([](double) { return 5.0; }, 3.0, 0.0, 1);
  EXPECT_FALSE(fitCornerSide(contour, 0, 1, 2.0, 60.0));
  EXPECT_FALSE(fitCornerSide(contour, 0, -1, 0.0, 60.0));
  Contour still;
  still.points = contourPoints(std::vector<Vec2>(20, Vec2(3, 3)), true);
  EXPECT_FALSE(fitCornerSide(still, 5, 1, 0.0, 60.0));
}

}  // namespace
}  // namespace batten
