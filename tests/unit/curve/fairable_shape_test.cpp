// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/fairable_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/curve/bezier_quintics.h"
#include "core/curve/closest_point.h"
#include "core/curve/corners_inside.h"
#include "core/curve/curvature.h"
#include "core/curve/curvature_jump.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

NurbsCurve polyline(const std::vector<Vec2>& points) {
  std::vector<double> knots{0.0};
  for (std::size_t i = 0; i < points.size(); ++i) knots.push_back(static_cast<double>(i));
  knots.push_back(knots.back());
  return NurbsCurve::make(1, knots, points).value();
}

/// Joints on an ellipse with the curvature of another curve at one of them: G2, but not smooth in the third derivative.
NurbsCurve chain(bool closed) {
  std::vector<Joint> joints;
  std::vector<double> lengths;
  const int count = 8;
  for (int i = 0; i <= (closed ? count : count / 2); ++i) {
    const double t = 2.0 * std::numbers::pi * i / count, a = 40.0, b = 25.0;
    const Vec2 first(-a * std::sin(t), b * std::cos(t)), second(-a * std::cos(t), -b * std::sin(t));
    const double speed = first.norm();
    joints.push_back(
        {Vec2(a * std::cos(t), b * std::sin(t)), first / speed, cross(first, second) / std::pow(speed, 3)});
    if (i > 0) lengths.push_back((joints[joints.size() - 1].point - joints[joints.size() - 2].point).norm() * 1.03);
  }
  return hermiteChain(joints, lengths).value();
}

double apartBothWays(const NurbsCurve& a, const NurbsCurve& b) {
  double worst = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const auto at = [&](const NurbsCurve& c) { return c.point(c.start() + (c.end() - c.start()) * i / 1000.0); };
    worst = std::max({worst, closestPoint(b, at(a)).distance, closestPoint(a, at(b)).distance});
  }
  return worst;
}

TEST(FairableShape, IsTheSameCurveWithMoreKnots) {
  const NurbsCurve corner = polyline({{0, 0}, {30, 0}, {30, 20}, {0, 20}});
  const std::optional<NurbsCurve> shape = fairableShape(corner);
  ASSERT_TRUE(shape);
  EXPECT_EQ(shape->degree(), 5);
  EXPECT_LT(apartBothWays(*shape, corner), 1e-10);
  EXPECT_GT(shape->breaks().size(), 16u);
  EXPECT_EQ(cornersInside(*shape).size(), 2u);
  EXPECT_EQ(cornersInside(corner).size(), 2u);
}

TEST(CornersInside, AreWhereTheDirectionBreaks) {
  EXPECT_TRUE(cornersInside(chain(true)).empty());
  EXPECT_FALSE(beginsAtCorner(chain(true)));
  EXPECT_TRUE(cornersInside(polyline({{0, 0}, {10, 0}, {25, 0}})).empty()) << "straight on";
  EXPECT_TRUE(beginsAtCorner(polyline({{0, 0}, {10, 0}, {5, 8}, {0, 0}})));
}

TEST(SmoothShape, LiesWithinTheToleranceAndHasNoJoints) {
  for (const bool closed : {false, true}) {
    const NurbsCurve joined = chain(closed);
    for (const double tolerance : {1e-2, 1e-4}) {
      const auto smooth = smoothShape(joined, closed, tolerance);
      ASSERT_TRUE(smooth) << closed << " " << tolerance;
      EXPECT_LE(apartBothWays(*smooth, joined), 1.1 * tolerance);
      EXPECT_LT(largestCurvatureJump(*smooth, closed), 1e-6);
      const auto knots = smooth->knots();
      for (std::size_t i = 1; i < knots.size(); ++i) {
        if (knots[i] > smooth->start() && knots[i] < smooth->end()) {
          EXPECT_GT(knots[i], knots[i - 1]) << "simple knots";
        }
      }
      if (!closed) {
        EXPECT_LT((smooth->point(smooth->start()) - joined.point(joined.start())).norm(), 1e-12);
        EXPECT_LT((smooth->point(smooth->end()) - joined.point(joined.end())).norm(), 1e-12);
        const auto directionAt = [](const NurbsCurve& c, double u) {
          return Vec2(c.derivatives(u, 1)[1].normalized());
        };
        for (const bool atEnd : {false, true}) {
          const double a = atEnd ? smooth->end() : smooth->start(), b = atEnd ? joined.end() : joined.start();
          EXPECT_NEAR(cross(directionAt(*smooth, a), directionAt(joined, b)), 0.0, 1e-12);
          EXPECT_NEAR(*curvature(*smooth, a), *curvature(joined, b), 1e-9);
        }
      } else {
        const auto a = smooth->derivatives(smooth->start(), 3), b = smooth->derivatives(smooth->end(), 3);
        for (std::size_t d = 0; d <= 3; ++d) EXPECT_LT((a[d] - b[d]).norm(), 1e-6 * (1.0 + a[d].norm())) << d;
      }
    }
  }
}

}  // namespace
}  // namespace batten
