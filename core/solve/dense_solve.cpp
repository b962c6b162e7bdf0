// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/dense_solve.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

namespace batten {

Eigen::VectorXd leastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

Eigen::MatrixXd nullSpace(const Eigen::MatrixXd& conditions) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(conditions.transpose());
  const Eigen::MatrixXd q = qr.householderQ();
  return q.rightCols(conditions.cols() - qr.rank());
}

Eigen::MatrixXd solveSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a.ldlt().solve(b); }

}  // namespace batten
