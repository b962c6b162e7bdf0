// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/edge_lengths.h"

#include <gtest/gtest.h>

#include "core/construct/bezier/bezier_chain.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

double angleOf(const Vec2& v) { return std::atan2(v.y(), v.x()); }

std::vector<Quintic> arcPath(double radius, int pieces) {
  const auto circle = [=](double t) { return Vec2(radius * std::cos(t), radius * std::sin(t)); };
  return bezierPath(test::stationsOf(circle, 0.0, 1.5, pieces + 1, false), false);
}

TEST(FollowCurvature, TakesTheCurvatureThatWasAskedFor) {
  // A path made of a circle of 100; wanted is 0.008 to 0.012, which edges of fixed direction can nearly follow.
  const auto path = arcPath(100.0, 3);
  const auto wanted = [](double share) { return 0.008 + 0.004 * share; };
  EdgeLengthOptions options;
  options.pinEnds = false;
  const auto made = followCurvature(path, wanted, options, {});
  ASSERT_EQ(made.path.size(), path.size());
  EXPECT_LT(made.misfitAfter, 0.01);
  EXPECT_LT(made.misfitAfter, 0.2 * made.misfitBefore);
  for (std::size_t k = 0; k < path.size(); ++k) {
    for (const std::size_t i : {0u, 4u}) {
      EXPECT_NEAR(angleOf(made.path[k][i + 1] - made.path[k][i]), angleOf(path[k][i + 1] - path[k][i]), 1e-9);
    }
    if (k == 0) continue;
    EXPECT_LT((made.path[k][0] - made.path[k - 1][5]).norm(), 1e-9);
    EXPECT_NEAR(*startCurvature(made.path[k]), *endCurvature(made.path[k - 1]), 1e-9 * 0.01);
  }
  EXPECT_NEAR(*startCurvature(made.path.front()), 0.008, 4e-4);
  EXPECT_NEAR(*endCurvature(made.path.back()), 0.012, 4e-4);
}

TEST(FollowCurvature, SolvesLargeChangesWithoutExploding) {
  const auto path = arcPath(100.0, 3);
  EdgeLengthOptions options;
  options.pinEnds = false;
  const auto made = followCurvature(path, [](double) { return 0.1; }, options, {});
  EXPECT_LT(made.misfitAfter, 0.02);
  // Ten times the curvature on the same directions: a tenth of the size.
  EXPECT_NEAR((made.path[0][5] - made.path[0][0]).norm(), 0.1 * (path[0][5] - path[0][0]).norm(), 0.5);
}

TEST(FollowCurvature, KeepsPinnedEnds) {
  const auto path = arcPath(100.0, 4);
  const auto made = followCurvature(path, [](double share) { return 0.008 + 0.004 * share; }, {}, {});
  for (std::size_t k = 0; k < path.size(); ++k) EXPECT_EQ(made.path[k][5], path[k][5]);
  EXPECT_LE(made.misfitAfter, made.misfitBefore);
}

TEST(FollowCurvature, LeavesInflectionsAndDegeneratePiecesAlone) {
  const Quintic turning = elevatedCubic({0, 0}, {10, 10}, {20, -10}, {30, 0});
  const Quintic point = elevatedCubic({30, 0}, {30, 0}, {30, 0}, {30, 0});
  const auto made = followCurvature(std::vector<Quintic>{turning}, [](double) { return 0.01; }, {}, {});
  EXPECT_EQ(made.path[0], turning);
  EXPECT_EQ(followCurvature(std::vector<Quintic>{point}, [](double) { return 0.01; }, {}, {}).why,
            Termination::Degenerate);
}

}  // namespace
}  // namespace batten
