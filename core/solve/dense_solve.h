// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace batten {

// Dense solvers of small problems, compiled once: their templates take seconds wherever they are instantiated.

/// x of smallest |a x - b|, by QR with column pivoting (a of full rank or not). Not finite where a or b is not.
Eigen::VectorXd leastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Orthonormal columns that span all x with conditions x = 0; as many as the conditions leave freedoms.
Eigen::MatrixXd nullSpace(const Eigen::MatrixXd& conditions);

/// Solution of a x = b for a symmetric semi-definite a, by LDL' with pivoting, a column of b at a time.
Eigen::MatrixXd solveSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace batten
