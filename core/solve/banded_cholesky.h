// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/solve/banded_matrix.h"

namespace batten {

/// L D L' factors of a positive definite BandedMatrix; linear cost. Cyclic matrices are folded (see foldedPlace), which
/// makes them open with twice the half width.
class BandedCholesky {
 public:
  /// @param leastPivot share of its diagonal entry that a pivot must exceed: by default what rounding leaves of a
  /// singular matrix; 0 takes whatever is positive.
  /// @return false if the matrix is not positive definite in this sense; the object is then useless.
  bool factor(const BandedMatrix&, double leastPivot = 1e-15);
  void solveInPlace(Eigen::VectorXd& x) const;
  Eigen::VectorXd solve(Eigen::VectorXd b) const {
    solveInPlace(b);
    return b;
  }
  /// The entries of the inverse within the band, as values (never to be added): Takahashi, Fagan & Chin (1973).
  /// Cyclic: @pre size > 2 halfWidth.
  BandedMatrix inverseBand() const;
  /// row A^-1 row', from the band of the inverse.
  static double quadratic(const BandedMatrix& inverseBand, const BandRow& row);

 private:
  int place(int index) const { return cyclic_ ? foldedPlace(index, size_) : index; }

  int size_ = 0, halfWidth_ = 0;  ///< Of the matrix.
  int band_ = 0;                  ///< Half width of the factor.
  bool cyclic_ = false;
  std::vector<double> lower_;  ///< Row r: L(r, r-band..r-1), then D(r).
};

}  // namespace batten
