// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace batten {

/// Least squares with few unknowns and any number of rows, of which only the normal equations are kept: the N unknowns
/// x for which the sum of weight * (row . x - value)^2 is least. With several `Sides` each row has as many values, and
/// each side unknowns of its own: x is N x Sides.
template <int N, int Sides = 1>
class SmallLeastSquares {
 public:
  using Row = Eigen::Matrix<double, N, 1>;  ///< As a column.
  using Values = Eigen::Matrix<double, 1, Sides>;
  using Normal = Eigen::Matrix<double, N, N>;
  using Unknowns = Eigen::Matrix<double, N, Sides>;

  void add(const Row& row, double value, double weight = 1.0) requires(Sides == 1) {
    normal_ += weight * row * row.transpose();
    right_ += weight * value * row;
  }
  void add(const Row& row, const Values& values) requires(Sides > 1) {
    normal_ += row * row.transpose();
    right_ += row * values;
  }
  void add(const SmallLeastSquares& other) {
    normal_ += other.normal_;
    right_ += other.right_;
  }
  /// Holds each unknown at 0, or at its own of `at`, with a weight that is not negative.
  void hold(const Row& diagonal) { normal_.diagonal() += diagonal; }
  void hold(const Row& diagonal, const Unknowns& at) {
    hold(diagonal);
    right_ += diagonal.asDiagonal() * at;
  }
  /// The sum of weight * row * row^T and of the weights of hold().
  const Normal& normal() const { return normal_; }
  /// The sum of weight * row * value, and likewise.
  const Unknowns& right() const { return right_; }
  /// Where the rows do not determine all unknowns: what they do not touch is 0; where only some combination of unknowns
  /// is determined, rounding decides on the others, which may be large. hold() with small weights prevents that.
  Unknowns solve() const { return normal_.ldlt().solve(right_); }

 private:
  Normal normal_ = Normal::Zero();
  Unknowns right_ = Unknowns::Zero();
};

}  // namespace batten
