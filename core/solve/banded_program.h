// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/solve/banded_matrix.h"
#include "core/solve/interior_point.h"

namespace batten {

/// min x'Ax - 2b'x subject to rows[i] . x >= bounds[i]; A positive definite and banded, every row within its band.
/// Row: BandRow or SparseRow.
template <class Row>
struct BandedProgram {
  BandedMatrix a;
  Eigen::VectorXd b;
  std::vector<Row> rows;
  std::vector<double> bounds;
  /// What the diagonal grows by, as a share of itself, where a system cannot be factorised.
  double ridge = 1e-13;
  double leastPivot = 1e-15;  ///< See BandedCholesky::factor.
};

/// The interior point method with banded normal equations: linear cost per iteration.
template <class Row>
InteriorPointResult solveProgram(const BandedProgram<Row>&, const InteriorPointLimits& limits = {},
                                 CancelCheck check = {});

extern template InteriorPointResult solveProgram(const BandedProgram<BandRow>&, const InteriorPointLimits&,
                                                 CancelCheck);
extern template InteriorPointResult solveProgram(const BandedProgram<SparseRow>&, const InteriorPointLimits&,
                                                 CancelCheck);

}  // namespace batten
