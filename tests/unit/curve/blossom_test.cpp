// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/blossom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/curve/foot_step.h"

namespace batten {
namespace {

const std::vector<double> kKnots = {0, 0, 0, 0, 1, 2.5, 4, 4, 4, 4};
const std::vector<Vec2> kPoints = {{0, 0}, {1, 2}, {3, 3}, {4, 0}, {6, -1}, {7, 2}};

Vec2 blossomAt(int span, std::array<double, 3> arguments) {
  return blossom(
      3, [](int i) { return kKnots[i]; }, [](int i) { return kPoints[i]; }, span, arguments.data());
}

TEST(Blossom, IsTheCurveWhereAllArgumentsAgree) {
  const auto curve = NurbsCurve::make(3, kKnots, kPoints).value();
  for (const double u : {0.0, 0.3, 1.0, 2.2, 2.5, 3.9, 4.0}) {
    EXPECT_LT((blossomAt(spanOf(3, kKnots, 6, u), {u, u, u}) - curve.point(u)).norm(), 1e-13) << u;
  }
}

TEST(Blossom, IsTheControlPointAtItsOwnKnotsAndSymmetric) {
  for (int j = 1; j < 5; ++j) {
    const std::array<double, 3> own = {kKnots[j + 1], kKnots[j + 2], kKnots[j + 3]};
    const int span = std::clamp(j, 3, 5);
    EXPECT_LT((blossomAt(span, own) - kPoints[j]).norm(), 1e-13);
    EXPECT_LT((blossomAt(span, {own[2], own[0], own[1]}) - kPoints[j]).norm(), 1e-13);
  }
}

TEST(SpanOf, TakesTheSpanThatBeginsAtAKnotAndTheLastOneAtTheEnd) {
  EXPECT_EQ(spanOf(3, kKnots, 6, -1.0), 3);
  EXPECT_EQ(spanOf(3, kKnots, 6, 0.0), 3);
  EXPECT_EQ(spanOf(3, kKnots, 6, 1.0), 4);
  EXPECT_EQ(spanOf(3, kKnots, 6, 2.5), 5);
  EXPECT_EQ(spanOf(3, kKnots, 6, 4.0), 5);
  EXPECT_EQ(spanOf(3, kKnots, 6, 9.0), 5);
}

TEST(FootStep, GoesToTheFootOnALineAndDownhillBeyondTheCentreOfACircle) {
  // The line (t, 0): one step. Circle of radius 2 at angle t, point at distance r from the centre along the x axis.
  EXPECT_DOUBLE_EQ(footStep(Vec2(-3, -5), Vec2(1, 0), Vec2(0, 0)), 3.0);
  for (const double r : {0.5, 1.9, 2.5, -3.0}) {
    const double t = 0.7;
    const Vec2 p(r, 0), at(2 * std::cos(t), 2 * std::sin(t));
    const Vec2 first(-2 * std::sin(t), 2 * std::cos(t)), second = -at;
    const double step = footStep(at - p, first, second);
    EXPECT_EQ(step<0.0, r> 0.0) << r;  // the foot is at t = 0, for a point on the other side at t = pi
    // Newton on (C - p) . C' = 2 r sin t, whose slope is 2 r cos t; near the centre Gauss and Newton's.
    const double slope = 2 * r * std::cos(t);
    EXPECT_NEAR(step, -2 * r * std::sin(t) / (slope > kFootTrust * 4.0 ? slope : 4.0), 1e-12);
  }
  EXPECT_EQ(footStep(Vec2(1, 1), Vec2(0, 0), Vec2(1, 0)), 0.0);
}

}  // namespace
}  // namespace batten
