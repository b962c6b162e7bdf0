// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/residual_blocks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace batten {
namespace {

TEST(MinimiseBlocks, FindsTheBottomOfRosenbrocksValley) {
  const std::vector<ResidualBlock> blocks = {{{0, 1}, 2, [](std::span<const double> x, std::span<double> r) {
                                                r[0] = 10.0 * (x[1] - x[0] * x[0]);
                                                r[1] = 1.0 - x[0];
                                              }}};
  const auto found = minimiseBlocks(Eigen::Vector2d(-1.2, 1.0), Eigen::Vector2d::Ones(), blocks, {});
  EXPECT_LT(found.run.cost, 1e-12);
  EXPECT_NEAR(found.before, 24.2, 1e-9);
  EXPECT_NEAR(found.x(0), 1.0, 1e-5);
  const std::vector<ResidualBlock> broken = {
      {{0}, 1, [](std::span<const double> x, std::span<double> r) { r[0] = std::log(-std::abs(x[0])); }}};
  EXPECT_EQ(minimiseBlocks(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Ones(1), broken, {}).run.why,
            Termination::Degenerate);
}

TEST(MinimiseBlocks, LeavesAnUnknownAloneThatNothingDependsOn) {
  const std::vector<ResidualBlock> blocks = {
      {{0}, 1, [](std::span<const double> x, std::span<double> r) { r[0] = x[0] - 3.0; }},
      {{1}, 1, [](std::span<const double>, std::span<double> r) { r[0] = 0.5; }}};
  const auto found = minimiseBlocks(Eigen::Vector2d(0.0, 7.0), Eigen::Vector2d::Ones(), blocks, {});
  EXPECT_NEAR(found.x(0), 3.0, 1e-6);
  EXPECT_EQ(found.x(1), 7.0);
  EXPECT_NEAR(found.run.cost, 0.25, 1e-12);
}

}  // namespace
}  // namespace batten
