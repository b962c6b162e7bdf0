// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/curve/closest_point.h"
#include "tests/support/clamped_knots.h"
#include "tests/support/growth.h"

namespace batten {
namespace {

/// Control points that jump about: curves full of hairpins, much narrower than a span.
NurbsCurve tangled(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const int count = 8 + static_cast<int>(random() % 5U);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) points.emplace_back(i + 6.0 * uniform(random), uniform(random));
  return NurbsCurve::make(5, test::clampedUnitKnots(5, count), points).value();
}

double bruteForce(const NurbsCurve& curve, const Vec2& p) {
  constexpr int kPlaces = 20000;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kPlaces; ++i) {
    least = std::min(least, (curve.point(curve.start() + (curve.end() - curve.start()) * i / kPlaces) - p).norm());
  }
  return least;
}

TEST(ClosestPoint, FindsTheTipOfEveryHairpin) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int line = 0; line < 60; ++line) {
    const NurbsCurve curve = tangled(random);
    for (int place = 0; place < 8; ++place) {
      const Vec2 on = curve.point(curve.start() + (curve.end() - curve.start()) * uniform(random));
      const Vec2 p = on + 0.02 * Vec2(uniform(random) - 0.5, uniform(random) - 0.5);
      EXPECT_LE(closestPoint(curve, p).distance, bruteForce(curve, p) + 1e-9) << "line " << line << ", place " << place;
    }
  }
}

TEST(Deviation, IsNotLostWhereTheFirstPointHasTwoSides) {
  // 10 out and back, then on the other way: the first point lies nearer to the side that leads nowhere.
  const auto curve =
      NurbsCurve::make(2, {0, 0, 0, 1, 2, 3, 4, 4, 4}, {{0, 0}, {8, 0}, {10, 0.5}, {8, 1}, {-200, 1}, {-300, 1}})
          .value();
  std::vector<Vec2> points;
  for (int x = 0; x >= -300; --x) points.emplace_back(x, 0.4);
  double largest = 0.0;
  for (const Vec2& p : points) largest = std::max(largest, bruteForce(curve, p));
  for (const bool ordered : {false, true}) EXPECT_NEAR(deviation(curve, points, ordered).max, largest, 1e-3);
}

/// An Archimedean spiral of this many turns one unit apart, its control points half a unit from each other, and points
/// along it, each a little beside it.
NurbsCurve spiral(int turns, std::vector<Vec2>& beside) {
  constexpr double kTurn = 2.0 * 3.14159265358979323846, kStep = 0.5, kBeside = 0.2;
  std::vector<Vec2> points;
  for (double angle = 0.0; angle < kTurn * turns;) {
    const double radius = 2.0 + angle / kTurn;
    const Vec2 out(std::cos(angle), std::sin(angle));
    points.push_back(radius * out);
    if (angle > 1.0 && angle < kTurn * turns - 1.0) beside.push_back((radius + kBeside) * out);
    angle += kStep / radius;
  }
  const int count = static_cast<int>(points.size());
  return NurbsCurve::make(3, test::clampedUnitKnots(3, count), points).value();
}

TEST(Deviation, OfACurveThatCutsACornerIsFoundBetweenTheSamples) {
  const NurbsCurve arc =
      NurbsCurve::make(2, {0.0, 0.0, 0.0, 1.0, 1.0, 1.0}, {Vec2(9, 0), Vec2(10, 0), Vec2(10, 1)}).value();
  const double cornerToArc = bruteForce(arc, Vec2(10, 0));
  double arcToCorner = 0.0;
  for (int i = 0; i <= 100000; ++i) {
    const Vec2 p = arc.point(i / 100000.0);
    arcToCorner = std::max(arcToCorner, std::min(p.y(), 10.0 - p.x()));
  }
  // The corner lies between two samples of its line; the arc that cuts it is farthest from it between two of its own.
  for (const double first : {1.003, 1.008, 1.031, 1.074}) {
    const NurbsCurve corner =
        NurbsCurve::make(1, {0.0, 0.0, 0.5, 1.0, 1.0}, {Vec2(10 - first, 0), Vec2(10, 0), Vec2(10, 1)}).value();
    EXPECT_NEAR(deviation(corner, arc).max, cornerToArc, 1e-4 * cornerToArc);
    EXPECT_NEAR(deviation(arc, corner).max, arcToCorner, 1e-4 * arcToCorner);
  }
}

TEST(Deviation, OfALongWindingLineTakesNoTimeWithTheSquareOfItsLength) {
  const auto secondsFor = [](int turns) {
    std::vector<Vec2> beside;
    const NurbsCurve curve = spiral(turns, beside);
    return test::secondsOf([&] {
      const Deviation found = deviation(curve, beside, false);
      EXPECT_LT(found.max, 0.3);
      EXPECT_GT(found.rms, 0.15);
    });
  };
  EXPECT_TRUE(test::growsAtMost(
      4.0 * 16.0, [&] { return secondsFor(8); }, [&] { return secondsFor(32); }))
      << "16 times the points and the length; 256 times if each looked at all of it";
}

}  // namespace
}  // namespace batten
