// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/termination.h"

namespace batten {

/// Residuals that depend on a few unknowns only.
struct ResidualBlock {
  std::vector<int> columns;  ///< The unknowns, in the order in which `evaluate` takes them.
  int size = 0;              ///< Number of residuals.
  std::function<void(std::span<const double> x, std::span<double> residuals)> evaluate;
};

struct LevenbergResult {
  Eigen::VectorXd x;  ///< The best found.
  Termination why = Termination::NotRun;
  int iterations = 0;
  double before = 0.0, after = 0.0;  ///< Sum of squares.
};

/// Smallest sum of squares over all blocks: Levenberg-Marquardt (damping 1e-3 diag(J'J), / 5 on success, x 4 on
/// failure, stop at a relative decrease below 1e-4 twice or 40 iterations) with central differences. Residuals that are
/// not finite make a step fail. @param scales size of a typical change of each unknown: the differences step 1e-5 of
/// it.
LevenbergResult minimiseBlocks(const Eigen::VectorXd& start, const Eigen::VectorXd& scales,
                               std::span<const ResidualBlock> blocks, const RunContext& context);

}  // namespace batten
