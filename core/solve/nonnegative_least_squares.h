// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

namespace batten {

/// Minimises |E x - f| subject to x >= 0 by the active set method of Lawson and Hanson (Solving Least Squares Problems,
/// 1974, ch. 23). Absent when it does not settle within 3 * columns changes of the active set.
std::optional<Eigen::VectorXd> nonnegativeLeastSquares(const Eigen::MatrixXd& e, const Eigen::VectorXd& f);

/// Minimises |A x - y| subject to G x >= h, by QR of A and least distance programming on top of the above (the same
/// book, ch. 23.4). Absent when A has not full column rank, the constraints contradict each other or the active set
/// does not settle.
std::optional<Eigen::VectorXd> constrainedLeastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& y,
                                                       const Eigen::MatrixXd& g, const Eigen::VectorXd& h);

}  // namespace batten
