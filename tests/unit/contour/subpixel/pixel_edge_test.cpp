// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/pixel_edge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contour/outline/subpixel_edges.h"
#include "core/contour/trace_contours.h"
#include "tests/support/angles.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

using test::kDeg;

/// Oracle: the ink in a pixel by brute force, 400 x 400 points, each blurred by itself.
double inkInPixel(double distance, const Vec2& normal, double blur) {
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (int y = 0; y < kSteps; ++y)
    for (int x = 0; x < kSteps; ++x) {
      const Vec2 p((x + 0.5) / kSteps - 0.5, (y + 0.5) / kSteps - 0.5);
      sum += 0.5 * std::erfc(-(distance + p.dot(normal)) / blur / std::numbers::sqrt2);
    }
  return sum / (kSteps * kSteps);
}

TEST(PixelResponse, IsTheInkInAPixel) {
  for (const int index : {0, 3, 15}) {
    const PixelResponse& response = PixelResponse::forBlur(index);
    for (const double angle : {0.0, 4.0, 22.5, 45.0, 101.25, 250.0}) {
      const Vec2 normal(std::cos(angle * kDeg), std::sin(angle * kDeg));
      const int direction = response.direction(normal);
      for (const double d : {-2.0, -0.7, -0.31, 0.0, 0.2, 0.55, 1.3})
        EXPECT_NEAR(response.at(d, direction).part, inkInPixel(d, normal, response.blur()), 4e-3) << angle << " " << d;
    }
  }
}

TEST(PixelResponse, SlopeIsTheDerivative) {
  const PixelResponse& response = PixelResponse::forBlur(7);
  for (int direction : {0, 9, 32})
    for (double d = -1.5; d < 1.5; d += 0.13) {
      const double slope = (response.at(d + 0.03, direction).part - response.at(d - 0.03, direction).part) / 0.06;
      EXPECT_NEAR(response.at(d, direction).slope, slope, 0.03);
    }
}

/// Nearly straight borders beat with the pixel grid: on a page without any blur they must lie where they were drawn, at
/// every angle, so that a long beat is never taken for a bend.
TEST(RefineOutline, EdgesWithoutBlurAreFreeOfTheBeatOfTheGrid) {
  constexpr int kSize = 400;
  for (const double angle : {0.0, 0.4, 1.0, 3.0, 17.0, 44.6}) {
    const Vec2 along(std::cos(angle * kDeg), std::sin(angle * kDeg)), across = leftNormal(along);
    const Vec2 centre(200.23, 200.41);
    const std::vector<Vec2> square{centre - 110 * along - 110 * across, centre + 110 * along - 110 * across,
                                   centre + 110 * along + 110 * across, centre - 110 * along + 110 * across};
    const Scan scan = test::renderPage(test::fillCoverage(square, kSize, kSize), kSize, kSize, test::cleanPage());
    BitImage ink(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) ink.set(x, y, scan.grey.level(x, y) < 135.0);
    EdgeParams edges;
    edges.mode = EdgeMode::Outline;
    const auto set = traceContours(ink, scan.grey, edges, {}, {});
    ASSERT_TRUE(set.has_value());
    double square2 = 0.0, worst = 0.0;
    int count = 0;
    for (const Vec2& p : positionsOf(set->contours.front().points)) {
      const double u = std::abs((p - centre).dot(along)), v = std::abs((p - centre).dot(across));
      if (std::min(u, v) > 98.0) continue;  // near a corner
      const double e = std::max(u, v) - 110.0;
      square2 += e * e;
      worst = std::max(worst, std::abs(e));
      ++count;
    }
    EXPECT_GT(count, 700);
    EXPECT_LT(std::sqrt(square2 / count), 0.004) << angle;
    EXPECT_LT(worst, 0.02) << angle;
  }
}

/// The same for the middle of a stroke.
TEST(Centreline, StrokesWithoutBlurAreFreeOfTheBeatOfTheGrid) {
  constexpr int kSize = 400;
  for (const double angle : {0.0, 0.4, 1.0, 17.0, 44.6}) {
    const Vec2 along(std::cos(angle * kDeg), std::sin(angle * kDeg)), across = leftNormal(along);
    const Vec2 centre(200.23, 200.41);
    const std::vector<Vec2> bar{centre - 150 * along - 2.5 * across, centre + 150 * along - 2.5 * across,
                                centre + 150 * along + 2.5 * across, centre - 150 * along + 2.5 * across};
    const Scan scan = test::renderPage(test::fillCoverage(bar, kSize, kSize), kSize, kSize, test::cleanPage());
    BitImage ink(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) ink.set(x, y, scan.grey.level(x, y) < 135.0);
    EdgeParams edges;
    edges.mode = EdgeMode::Centreline;
    const auto set = traceContours(ink, scan.grey, edges, {}, {});
    ASSERT_TRUE(set.has_value());
    double worst = 0.0, square = 0.0;
    int count = 0;
    for (const Vec2& p : positionsOf(set->contours.front().points)) {
      if (std::abs((p - centre).dot(along)) > 135.0) continue;
      const double e = (p - centre).dot(across);
      square += e * e;
      worst = std::max(worst, std::abs(e));
      ++count;
    }
    EXPECT_GT(count, 250);
    EXPECT_LT(std::sqrt(square / count), 0.008) << angle;
    EXPECT_LT(worst, 0.02) << angle;
  }
}

}  // namespace
}  // namespace batten
