// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/solve/banded_matrix.h"

namespace batten {

/// Rows over few unknowns each, such as those of the knot spans of a curve. Neighbours over the same unknowns stand
/// together as one dense block, which products go through at once: in time of the numbers alone, without looking up
/// unknowns row by row.
class RowGroups {
 public:
  Eigen::Index count() const { return count_; }
  /// Largest distance from the first unknown of a row to its last: the half width of a matrix that such rows make.
  int width() const { return width_; }
  /// @param index the unknowns, ascending; @param factor the values are multiplied by it.
  void add(std::span<const int> index, std::span<const double> values, double factor = 1.0);
  /// Multiplies each row by what `factorOf(unknowns, values)` says of it, and hands the factor to `done(row, factor)`.
  template <class FactorOf, class Done>
  void scale(const FactorOf& factorOf, const Done& done) {
    for (const Group& group : groups_) {
      for (Eigen::Index i = 0; i < group.rows; ++i) {
        const std::span<double> values(values_.data() + group.firstValue + i * std::ssize(indexOf(group)), group.size);
        const double factor = factorOf(indexOf(group), std::span<const double>(values));
        for (double& v : values) v *= factor;
        done(group.firstRow + i, factor);
      }
    }
  }

  double dot(Eigen::Index row, const Eigen::VectorXd& x) const;
  /// x += factor * row'.
  void addTo(Eigen::VectorXd& x, Eigen::Index row, double factor) const;
  /// All rows times x.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;
  /// x += the sum of weight[i] * row i'.
  void addTransposed(const Eigen::VectorXd& weight, Eigen::VectorXd& x) const;
  /// m += the sum of weight[i] * row i' row i.
  void addOuter(const Eigen::VectorXd& weight, BandedMatrix& m) const;

 private:
  struct Group {
    std::ptrdiff_t firstIndex = 0, firstValue = 0;
    Eigen::Index firstRow = 0, rows = 0;
    std::size_t size = 0;  ///< Unknowns.
  };
  std::span<const int> indexOf(const Group& group) const {
    return std::span(index_).subspan(group.firstIndex, group.size);
  }
  const Group& groupOf(Eigen::Index row) const;

  std::vector<Group> groups_;
  std::vector<int> index_;
  std::vector<double> values_;  ///< Row by row.
  Eigen::Index count_ = 0;
  int width_ = 0;
};

}  // namespace batten
