// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "core/construct/light/light_shape.h"
#include "core/solve/banded_matrix.h"

namespace batten {

/// The symmetric matrix of a fit's normal equations, over x and y of every control point and then the span lengths (see
/// LightSystem::gauss). A span couples only what lies near it: the matrix of a long curve is kept as a band, with the
/// unknowns in the order of travel, so that memory and time grow with its length and not with the square and the cube.
class LightMatrix {
 public:
  /// @param lengths whether the span lengths are unknowns, too
  LightMatrix(const LightShape& shape, bool lengths);

  Eigen::Index unknowns() const { return unknowns_; }
  void setZero();
  /// += value at (row, column) and the place that mirrors it; once where both are the same.
  void add(Eigen::Index row, Eigen::Index column, double value) {
    if (!place_.empty()) return addToBand(row, column, value);
    dense_.coeffRef(std::max(row, column), std::min(row, column)) += value;
  }
  /// Solves with every diagonal entry raised by its `damping`-th part; nullopt if the matrix is then not positive
  /// definite.
  std::optional<Eigen::VectorXd> solveDamped(double damping, const Eigen::VectorXd& right);

 private:
  void addToBand(Eigen::Index row, Eigen::Index column, double value);
  void orderUnknowns(const LightShape& shape, bool lengths);

  Eigen::Index unknowns_;
  Eigen::MatrixXd dense_, damped_;  ///< Lower triangles. Of short curves; else empty.
  BandedMatrix band_;               ///< Of long ones.
  std::vector<int> place_;          ///< Of the unknowns in the band.
};

}  // namespace batten
