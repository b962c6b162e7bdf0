// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

namespace batten {

/// Of so many unknowns what is zero is passed over: each row of a path holds those of a few elements only.
bool isSparseSystem(Eigen::Index unknowns);

/// += row' row, lower triangle.
void addOuter(Eigen::MatrixXd& squared, const Eigen::RowVectorXd& row);

/// Solves symmetric positive definite equations, of which the lower triangle is given.
class NormalSolver {
 public:
  explicit NormalSolver(const Eigen::MatrixXd& matrix);
  bool isSolved() const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  bool isSparse_;
  Eigen::LDLT<Eigen::MatrixXd> dense_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> sparse_;
};

}  // namespace batten
