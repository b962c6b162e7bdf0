// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/solve/band_kernels.h"
#include "core/solve/banded_matrix.h"

namespace batten {

/// The rows of a program over a banded matrix, laid out for products with all of them: neighbours over the same
/// unknowns by fours. Every sum is made in the order of the rows, as dot(), addTo() and BandedMatrix::addOuter() make
/// it one row after the other: the results are the same to the last bit.
class PackedRows {
 public:
  PackedRows(std::span<const BandRow> rows, int unknowns);

  Eigen::Index count() const { return static_cast<Eigen::Index>(source_.size()); }
  /// out[i] = row i . x, in memory that the caller keeps from step to step.
  void times(const Eigen::VectorXd& x, Eigen::VectorXd& out) const;
  /// x += the sum of weight[i] * row i'.
  void addTransposed(const Eigen::VectorXd& weight, Eigen::VectorXd& x) const;
  /// m += the sum of weight[i] * row i' row i. @pre m has the half width of such rows, BandRow::kHalfWidth.
  void addOuter(const Eigen::VectorXd& weight, BandedMatrix& m) const;

 private:
  /// Either rows by fours, or one row that runs on from the last unknown to the first.
  struct Section {
    RowFours fours = {};
    const BandRow* across = nullptr;
    int row = 0;  ///< The first.
  };

  std::span<const BandRow> source_;
  std::vector<double> rows_, lanes_;
  std::vector<RowFour> fours_;
  std::vector<Section> sections_;
};

}  // namespace batten
