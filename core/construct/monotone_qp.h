// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "core/base/termination.h"
#include "core/construct/banded_matrix.h"

namespace batten {

/// min x'Ax - 2b'x subject to rows[i] . x >= bounds[i]; A positive definite and banded, every row six neighbours.
struct MonotoneQp {
  BandMatrix a;
  Eigen::VectorXd b;
  std::vector<BandRow> rows;
  std::vector<double> bounds;
};

struct MonotoneQpResult {
  /// Converged; ToleranceLimited when `abortAbove` was exceeded; IterationLimit; Degenerate when a system was singular.
  Termination why = Termination::NotRun;
  Eigen::VectorXd x;
  double objective = 0.0;   ///< x'Ax - 2b'x.
  double lowerBound = 0.0;  ///< No feasible x has a smaller objective.
  int iterations = 0;
};

/// Mehrotra's predictor-corrector method (SIAM J. Optim. 2, 1992) with banded normal equations: linear cost per
/// iteration.
/// @param abortAbove stops as soon as the objective is proven to exceed this.
MonotoneQpResult solveMonotoneQp(const MonotoneQp&, double abortAbove = std::numeric_limits<double>::infinity());

}  // namespace batten
