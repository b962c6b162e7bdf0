// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/solve/banded_matrix.h"

namespace batten {

/// L D L' factors of a positive definite open BandedMatrix by columns, two at a time: for bands much wider than those
/// of splines, where vector instructions serve columns better than the rows of BandedCholesky. Its sums are in another
/// order, so that the results differ by rounding.
class ColumnCholesky {
 public:
  /// @pre not cyclic. @param leastPivot share of its diagonal entry that a pivot must exceed; 0 takes whatever is
  /// positive.
  /// @return false if the matrix is not positive definite in this sense; the object is then useless.
  bool factor(const BandedMatrix&, double leastPivot);
  void solveInPlace(Eigen::VectorXd& x) const;

 private:
  double* column(int c) { return lower_.data() + std::ptrdiff_t{c} * (band_ + 1); }
  const double* column(int c) const { return lower_.data() + std::ptrdiff_t{c} * (band_ + 1); }
  /// Entries of a column below its diagonal.
  int below(int c) const { return std::min(band_, size_ - 1 - c); }
  void eliminate(int c, double* first, double* second);

  int size_ = 0, band_ = 0;
  std::vector<double> lower_;  ///< Column c: D(c), then L(c + 1 .. c + band, c).
  Eigen::ArrayXd a_, b_;       ///< Two columns as they were, from the second row below the first one's diagonal on.
};

}  // namespace batten
