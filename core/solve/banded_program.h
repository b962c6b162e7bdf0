// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/solve/banded_matrix.h"
#include "core/solve/interior_point.h"
#include "core/solve/row_groups.h"

namespace batten {

/// min x'Ax - 2b'x subject to rows[i] . x >= bounds[i]; A positive definite and banded, every row within its band.
/// Rows: std::vector<BandRow>, or RowGroups and then A not cyclic.
template <class Rows>
struct ProgramOver {
  BandedMatrix a;
  Eigen::VectorXd b;
  Rows rows;
  std::vector<double> bounds;  ///< One a row.
  /// What the diagonal grows by, as a share of itself, where a system cannot be factorised.
  double ridge = 1e-13;
  double leastPivot = 1e-15;  ///< See BandedCholesky::factor.
};
using BandedProgram = ProgramOver<std::vector<BandRow>>;
using GroupedProgram = ProgramOver<RowGroups>;

/// The interior point method with banded normal equations: linear cost per iteration.
InteriorPointResult solveProgram(const BandedProgram&, const InteriorPointLimits& limits = {}, CancelCheck check = {});
InteriorPointResult solveProgram(const GroupedProgram&, const InteriorPointLimits& limits = {}, CancelCheck check = {});

}  // namespace batten
