// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/curve_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

/// A smooth loop: a periodic uniform quintic through a bumpy ring, with clamped ends over 0..120.
NurbsCurve ring() {
  std::vector<Vec2> points;
  std::vector<double> knots;
  const int n = 12;
  for (int i = 0; i < n + 5; ++i) {
    const double a = 2 * M_PI * i / n, r = 18 + 3 * std::sin(3 * a);
    points.emplace_back(r * std::cos(a), 0.8 * r * std::sin(a));
  }
  for (int i = 0; i < n + 11; ++i) knots.push_back(10.0 * (i - 5));
  return clamped(NurbsCurve::make(5, knots, points).value()).value();
}

TEST(CurveStart, TheLoopIsTheSameFromAnotherPlaceOn) {
  const NurbsCurve loop = ring();
  for (const double u : {3.0, 37.0, 60.0, 119.0}) {
    const auto turned = startedAt(loop, u);
    ASSERT_TRUE(turned) << turned.error().message;
    EXPECT_NEAR(turned->end() - turned->start(), 120.0, 1e-9);
    for (int i = 0; i <= 200; ++i) {
      const double t = 120.0 * i / 200.0, there = std::fmod(u + t, 120.0);
      EXPECT_LT((turned->point(turned->start() + t) - loop.point(there)).norm(), 1e-9) << u << " + " << t;
    }
  }
}

TEST(CurveStart, TheOldSeamKeepsNoMoreKnotsThanItNeeds) {
  const auto turned = startedAt(ring(), 37.0);
  ASSERT_TRUE(turned);
  const auto knots = turned->knots();
  for (const double u : turned->breaks()) {
    if (u <= turned->start() || u >= turned->end()) continue;
    EXPECT_EQ(std::count(knots.begin(), knots.end(), u), 1) << u;
  }
  // A loop that meets in place only: its seam is a corner, and stays one.
  std::vector<Vec2> drop;
  for (const Vec2& p : {Vec2(0, 0), Vec2(30, 10), Vec2(40, 40), Vec2(-40, 40), Vec2(-30, 12), Vec2(0, 0)})
    drop.push_back(p);
  const NurbsCurve cornered = NurbsCurve::make(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, drop).value();
  const auto begun = startedAt(cornered, 0.25);
  ASSERT_TRUE(begun);
  const double seam = begun->breaks()[1];
  EXPECT_LT((begun->point(seam) - Vec2(0, 0)).norm(), 1e-9);
  EXPECT_EQ(std::count(begun->knots().begin(), begun->knots().end(), seam), 5);
}

TEST(CurveStart, IsTakenToThePointNearestToAPlace) {
  const NurbsCurve loop = ring();
  const NurbsCurve turned = startedNear(loop, 1.001 * loop.point(37.0));
  EXPECT_LT((turned.point(turned.start()) - loop.point(37.0)).norm(), 0.05);
  EXPECT_LT((turned.point(turned.end()) - turned.point(turned.start())).norm(), 1e-9);
}

TEST(CurveStart, AtTheStartNothingChanges) {
  const NurbsCurve loop = ring();
  EXPECT_TRUE(*startedAt(loop, loop.start()) == loop);
  EXPECT_TRUE(*startedAt(loop, loop.end()) == loop);
}

}  // namespace
}  // namespace batten
