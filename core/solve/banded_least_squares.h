// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/vec2.h"
#include "core/solve/banded_matrix.h"

namespace batten {

/// Linear least squares with a banded matrix and two right-hand sides (x and y), by Givens rotations, row by row: the
/// normal equations are never formed. Cost: rows * width^2.
class BandedLeastSquares {
 public:
  /// @param unknowns number of columns; @param width largest distance between first and last column of a row, plus one.
  /// @param cyclic column numbers are taken modulo `unknowns` (periodic splines). The columns are then folded
  /// (see foldedPlace), which keeps a band of twice the width.
  BandedLeastSquares(int unknowns, int width, bool cyclic);

  /// Adds the equation sum values[j] * x[first + j] = right.
  void add(int first, std::span<const double> values, const Vec2& right);
  /// The solution; absent if the columns are linearly dependent to machine precision.
  std::optional<std::vector<Vec2>> solve() const;

 private:
  int place(int column) const { return cyclic_ ? foldedPlace(column % unknowns_, unknowns_) : column; }
  double& factor(int row, int offset) { return factor_[std::ptrdiff_t{row} * band_ + offset]; }
  double factor(int row, int offset) const { return factor_[std::ptrdiff_t{row} * band_ + offset]; }

  int unknowns_, band_;
  bool cyclic_;
  std::vector<double> factor_;  ///< Upper triangle: row r holds columns r .. r + band - 1.
  std::vector<Vec2> right_;
  std::vector<double> work_;
};

}  // namespace batten
