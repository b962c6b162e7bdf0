// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace batten {

/// A symmetric banded matrix, of which the lower half is stored: entry (i, j), j <= i <= j + halfWidth.
class BandedMatrix {
 public:
  BandedMatrix() = default;
  BandedMatrix(int size, int halfWidth)
      : size_(size),
        halfWidth_(halfWidth),
        data_(static_cast<std::size_t>(size) * static_cast<std::size_t>(halfWidth + 1), 0.0) {}
  int size() const { return size_; }
  int halfWidth() const { return halfWidth_; }
  double& at(int i, int j) { return data_[offset(i, j)]; }
  double at(int i, int j) const { return data_[offset(i, j)]; }
  /// this += factor * other, of the same shape.
  void add(const BandedMatrix& other, double factor);

  /// Cholesky in place. False when the matrix is not positive definite to rounding; the content is then void.
  bool factorize();
  /// Solves with the factor in place.
  void solve(Eigen::VectorXd& x) const;

 private:
  std::size_t offset(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(halfWidth_ + 1) + static_cast<std::size_t>(i - j);
  }
  int size_ = 0, halfWidth_ = 0;
  std::vector<double> data_;
};

}  // namespace batten
