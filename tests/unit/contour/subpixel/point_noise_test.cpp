// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/point_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/contour/centreline/centreline.h"
#include "core/contour/outline/crack_contours.h"
#include "core/contour/outline/subpixel_edges.h"
#include "tests/support/contour_shapes.h"

namespace batten {
namespace {

constexpr double kNoiseRadius = 70.0;
const Vec2 kNoisyCentre(100.3, 99.6);

/// The page with white noise whose standard deviation grows from left to right.
GreyImage noisy(const GreyImage& clean, double left, double right, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  GreyImage grey = clean;
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      const double sigma = std::lerp(left, right, (x + 0.5) / grey.width);
      const double level = clean.level(x, y) + sigma * normal(random);
      grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * GreyImage::kGreyUnit));
    }
  }
  return grey;
}

/// Mean squares of what points miss a circle by, and of what they are said to miss it by, left and right of its centre.
struct Halves {
  double missed[2] = {0.0, 0.0}, said[2] = {0.0, 0.0};
  int count[2] = {0, 0};
  void add(const Contour& c, double radius) {
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      ASSERT_TRUE(c.points[i].sigmaPx);
      if (!c.points[i].refined) continue;
      const double across = c.points[i].at.x() - kNoisyCentre.x();
      if (std::abs(across) < 0.4 * radius) continue;
      const int side = across > 0.0 ? 1 : 0;
      const double e = (c.points[i].at - kNoisyCentre).norm() - radius;
      missed[side] += e * e;
      said[side] += static_cast<double>(c.points[i].sigmaPx.value()) * c.points[i].sigmaPx.value();
      ++count[side];
    }
  }
  double ratio(int side) const { return std::sqrt(said[side] / missed[side]); }
};

TEST(PointSigmas, SayHowFarBordersScatter) {
  test::RenderSettings s;
  s.ink = 130.0;
  s.slope = -0.25;
  const GreyImage clean = test::renderShape(
      [](double x, double y) { return std::hypot(x - kNoisyCentre.x(), y - kNoisyCentre.y()) < kNoiseRadius; }, s);
  auto set = crackContours(test::thresholdMask(clean, 155.0), false, 100.0, {});
  ASSERT_TRUE(set.has_value());
  ASSERT_FALSE(set->contours.empty());
  Halves halves;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Contour c = set->contours.front();
    refineOutline(c, noisy(clean, 1.0, 9.0, seed), {});
    halves.add(c, kNoiseRadius);
  }
  for (const int side : {0, 1}) EXPECT_NEAR(halves.ratio(side), 1.0, 0.25) << side;
  EXPECT_GT(halves.missed[1] / halves.count[1], 4.0 * halves.missed[0] / halves.count[0]);
}

TEST(PointSigmas, SayHowFarCentreLinesScatter) {
  test::RenderSettings s;
  s.ink = 110.0;
  const GreyImage clean = test::renderShape(
      [](double x, double y) {
        return std::abs(std::hypot(x - kNoisyCentre.x(), y - kNoisyCentre.y()) - kNoiseRadius) < 2.5;
      },
      s);
  const BitImage ink = test::thresholdMask(clean, 170.0);
  Halves halves;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const auto set = centrelines(ink, noisy(clean, 1.0, 8.0, seed), {}, {});
    ASSERT_TRUE(set.has_value());
    ASSERT_EQ(set->contours.size(), 1U);
    halves.add(set->contours.front(), kNoiseRadius);
  }
  for (const int side : {0, 1}) EXPECT_NEAR(halves.ratio(side), 1.0, 0.25) << side;
}

TEST(PointSigmas, StayWithTheirPointsWhereEndsAreMoved) {
  test::RenderSettings s;
  s.ink = 110.0;
  const GreyImage clean = test::renderShape(
      [](double x, double y) { return x > 20.0 && x < 180.0 && std::abs(y - 90.3 - 0.05 * x) < 2.5; }, s);
  const BitImage ink = test::thresholdMask(clean, 170.0);
  double left = 0.0, right = 0.0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const auto set = centrelines(ink, noisy(clean, 1.0, 9.0, seed), {}, {});
    ASSERT_TRUE(set.has_value());
    ASSERT_EQ(set->contours.size(), 1U);
    const Contour& c = set->contours.front();
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      ASSERT_TRUE(c.points[i].sigmaPx);
      if (c.points[i].at.x() > 30.0 && c.points[i].at.x() < 70.0) left += c.points[i].sigmaPx.value();
      if (c.points[i].at.x() > 130.0 && c.points[i].at.x() < 170.0) right += c.points[i].sigmaPx.value();
    }
  }
  // The noise is 7 at the right and 3 at the left, on the mean.
  EXPECT_GT(right, 1.8 * left);
  EXPECT_LT(right, 4.0 * left);
}

TEST(PointSigmas, AreNotBestWhereNothingIsKnown) {
  for (const std::size_t from : {std::size_t{0}, std::size_t{70}, std::size_t{140}}) {
    std::vector<std::optional<PointInformation>> points(200, PointInformation{0.01, 40.0, 10.0});  // noise of 2
    for (std::size_t i = from; i < from + 60; ++i) points[i] = PointInformation{0.02, 0.0, 0.0};   // half as well known
    const std::vector<float> sigma = pointSigmas(points, false);
    const double expected = std::hypot(0.04, 0.01);
    for (std::size_t i = from; i < from + 60; ++i) EXPECT_NEAR(sigma[i], expected, 0.1 * expected) << from << " " << i;
  }
  const std::vector<std::optional<PointInformation>> none(50, PointInformation{0.02, 0.0, 0.0});
  for (const float s : pointSigmas(none, false)) EXPECT_GT(s, 0.3f);
}

TEST(PointSigmas, HoldBackSurprisesAndPointsThatWereNotPlaced) {
  std::vector<std::optional<PointInformation>> points(200, PointInformation{0.01, 40.0, 10.0});  // noise of 2
  points[100]->squares = 4e5;  // a hundred times the noise
  points[30].reset();
  points[40].reset();
  const std::vector<float> sigma = pointSigmas(points, false);
  const double expected = std::hypot(0.02, 0.01);
  EXPECT_NEAR(sigma[0], expected, 0.05 * expected);
  EXPECT_NEAR(sigma[99], expected, 0.05 * expected);
  EXPECT_GT(sigma[30], 0.3f);
  EXPECT_GT(sigma[40], 0.3f);
  EXPECT_NEAR(sigma[35], expected, 0.05 * expected);
}

}  // namespace
}  // namespace batten
