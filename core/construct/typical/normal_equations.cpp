// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/normal_equations.h"

#include <vector>

namespace batten {
namespace {

constexpr Eigen::Index kManyUnknowns = 150;  // of a dense matrix, from which on the sparse one is faster

}  // namespace

bool isSparseSystem(Eigen::Index unknowns) { return unknowns >= kManyUnknowns; }

void addOuter(Eigen::MatrixXd& squared, const Eigen::RowVectorXd& row) {
  std::vector<Eigen::Index> places;
  for (Eigen::Index i = 0; i < row.size(); ++i)
    if (row(i) != 0.0) places.push_back(i);
  for (std::size_t b = 0; b < places.size(); ++b)
    for (std::size_t a = b; a < places.size(); ++a) squared(places[a], places[b]) += row(places[a]) * row(places[b]);
}

NormalSolver::NormalSolver(const Eigen::MatrixXd& matrix) : isSparse_(isSparseSystem(matrix.rows())) {
  if (!isSparse_) {
    dense_.compute(matrix);
    return;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index col = 0; col < matrix.cols(); ++col)
    for (Eigen::Index row = col; row < matrix.rows(); ++row)
      if (matrix(row, col) != 0.0) entries.emplace_back(static_cast<int>(row), static_cast<int>(col), matrix(row, col));
  Eigen::SparseMatrix<double> filled(matrix.rows(), matrix.cols());
  filled.setFromTriplets(entries.begin(), entries.end());
  sparse_.compute(filled);
}

bool NormalSolver::isSolved() const { return (isSparse_ ? sparse_.info() : dense_.info()) == Eigen::Success; }

Eigen::MatrixXd NormalSolver::solve(const Eigen::MatrixXd& right) const {
  if (isSparse_) return sparse_.solve(right);
  return dense_.solve(right);
}

}  // namespace batten
