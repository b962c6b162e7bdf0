// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "core/solve/banded_matrix.h"
#include "core/solve/interior_point.h"

namespace batten {

/// min x'Ax - 2b'x subject to rows[i] . x >= bounds[i]; A positive definite and banded, every row six neighbours.
struct MonotoneQp {
  BandMatrix a;
  Eigen::VectorXd b;
  std::vector<BandRow> rows;
  std::vector<double> bounds;
};

using MonotoneQpResult = InteriorPointResult;

/// The interior point method of core/solve with banded normal equations: linear cost per iteration.
/// @param abortAbove stops as soon as the objective is proven to exceed this.
MonotoneQpResult solveMonotoneQp(const MonotoneQp&, double abortAbove = std::numeric_limits<double>::infinity());

}  // namespace batten
