// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/solve/levenberg_marquardt.h"

namespace batten {

/// Residuals that depend on a few unknowns only.
struct ResidualBlock {
  std::vector<int> columns;  ///< The unknowns, in the order in which `evaluate` takes them.
  int size = 0;              ///< Number of residuals.
  std::function<void(std::span<const double> x, std::span<double> residuals)> evaluate;
};

struct BlockSolution {
  Eigen::VectorXd x;    ///< The best found.
  LevenbergRun run;     ///< With the sum of squares there.
  double before = 0.0;  ///< The sum of squares at the start.
};

/// Smallest sum of squares over all blocks by Levenberg-Marquardt, damped by diag(J'J), with central differences.
/// Residuals that are not finite make a step fail. @param scales size of a typical change of each unknown: the
/// differences step 1e-5 of it.
BlockSolution minimiseBlocks(const Eigen::VectorXd& start, const Eigen::VectorXd& scales,
                             std::span<const ResidualBlock> blocks, const RunContext& context);

}  // namespace batten
