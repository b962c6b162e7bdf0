// SPDX-License-Identifier: GPL-3.0-or-later
// The deviation that fairing measures against many closest points of either curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/curve/closest_point.h"
#include "core/fairing/model/coarse_setups.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/model/sketch_deviation.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

constexpr int kPoints = 40, kCurves = 200;

double farthestOf(const NurbsCurve& from, const NurbsCurve& to) {
  constexpr int kSamples = 2000;
  const ClosestPointFinder finder(to);
  double farthest = 0.0;
  for (int i = 0; i <= kSamples; ++i) {
    const double u = from.start() + (from.end() - from.start()) * i / kSamples;
    farthest = std::max(farthest, finder.closestTo(from.point(u)).distance);
  }
  return farthest;
}

/// Control points moved together over a few spans or all, along the line too.
std::vector<Vec2> moved(const std::vector<Vec2>& points, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Vec2> result = points;
  const double size = std::pow(10.0, -3.0 + 3.0 * uniform(random)), width = 1.0 + 12.0 * uniform(random);
  for (int bump = 0; bump < 4; ++bump) {
    const double centre = uniform(random) * (kPoints - 1), along = size * (3.0 * uniform(random) - 1.5);
    const double across = size * (2.0 * uniform(random) - 1.0);
    for (int i = 1; i + 1 < kPoints; ++i) {
      const double away = (i - centre) / width;
      result[i] += std::exp(-away * away) * Vec2(along, across);
    }
  }
  return result;
}

TEST(SketchDeviation, IsThatOfManyClosestPoints) {
  std::mt19937 random(5);
  for (int k = 0; k < kCurves; ++k) {
    const NurbsCurve sketched = test::noisy(test::wave(280.0, 30.0, kPoints), 0.1, k);
    const auto setup = makeSetup(sketched, false, {});
    ASSERT_TRUE(setup);
    const std::vector<Vec2> points = moved((*setup)->points, random);
    const auto curve = toCurve(**setup, points);
    ASSERT_TRUE(curve);
    const double there = farthestOf(*curve, sketched), both = std::max(there, farthestOf(sketched, *curve));
    EXPECT_NEAR(largestDeviation(**setup, points), there, 0.01 * there) << "curve " << k;
    EXPECT_NEAR(largestDeviation(**setup, points, true), both, 0.01 * both) << "curve " << k;
    for (const double share : {0.3, 0.9, 0.99, 1.0})
      EXPECT_FALSE(isClearlyWithin(**setup, points, share * both)) << "curve " << k << ", " << share;
    for (const double share : {1.04, 1.2, 3.0, 20.0})
      EXPECT_TRUE(isClearlyWithin(**setup, points, share * both)) << "curve " << k << ", " << share;
    const double enough = 0.5 * both;
    const double part = largestDeviation(**setup, points, true, enough);
    EXPECT_GT(part, enough) << "curve " << k;
    EXPECT_LE(part, 1.01 * both) << "curve " << k;
  }
}

/// Control points moved along the line by up to about `slide`, so that feet lie ahead of where they are looked for or
/// behind it, and a little in any direction.
std::vector<Vec2> slid(const std::vector<Vec2>& points, double slide, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<Vec2> result = points;
  const double most = slide * normal(random);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    result[i] += Vec2(most * std::sin(2.0 * std::numbers::pi * share), 0.5 * normal(random));
  }
  return result;
}

/// Does something with every start over fewer knots of a noisy wave, its points slid, and with the true deviation.
template <class Check>
void eachOverFewerKnots(double height, int seed, double slide, std::mt19937& random, const Check& check) {
  const NurbsCurve sketched = test::noisy(test::wave(200.0, height, kPoints), 0.2, seed);
  const auto sketch = makeSetup(sketched, false, {});
  ASSERT_TRUE(sketch);
  for (const auto& coarse : coarseSetups(*sketch)) {
    const std::vector<Vec2> points = slid(coarse->points, slide, random);
    const auto curve = toCurve(*coarse, points);
    ASSERT_TRUE(curve);
    check(*coarse, points, std::max(farthestOf(*curve, sketched), farthestOf(sketched, *curve)));
  }
}

// Over fewer knots a place of one curve says only about where its foot is on the other.
TEST(SketchDeviation, OverFewerKnotsIsThatOfManyClosestPoints) {
  std::mt19937 random(6);
  int looked = 0;
  for (int k = 0; k < kCurves / 4; ++k) {
    SCOPED_TRACE(k);
    eachOverFewerKnots(10.0 + k, k, 3.0, random,
                       [&](const FairingSetup& setup, const std::vector<Vec2>& points, double both) {
                         EXPECT_NEAR(largestDeviation(setup, points, true) / both, 1.01, 0.015);
                         EXPECT_FALSE(isClearlyWithin(setup, points, both));
                         EXPECT_TRUE(isClearlyWithin(setup, points, 1.06 * both));
                         ++looked;
                       });
  }
  EXPECT_GT(looked, kCurves / 4);
}

// Where feet lie so far along the line that some are missed, what was found at the places before still leads to none
// that is plainly on another branch.
TEST(SketchDeviation, IsNotThatOfAnotherBranch) {
  std::mt19937 random(7);
  for (int k = 0; k < kCurves; k += 2) {
    SCOPED_TRACE(k);
    eachOverFewerKnots(10.0 + 0.3 * k, k, 10.0, random,
                       [](const FairingSetup& setup, const std::vector<Vec2>& points, double both) {
                         EXPECT_LT(largestDeviation(setup, points, true), 3.0 * both);
                       });
  }
}

}  // namespace
}  // namespace batten
