// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace batten {

/// Six consecutive numbers of a row of a spline system; columns first..first+5, modulo the number of unknowns.
struct BandRow {
  int first = 0;
  std::array<double, 6> v{};
};

/// row . x, with column numbers modulo the size of x.
double dot(const BandRow& row, const Eigen::VectorXd& x);
/// x += factor * row'.
void addTo(Eigen::VectorXd& x, const BandRow& row, double factor);

/// Symmetric matrix with half bandwidth 5, as uniform quintic splines make it. Cyclic: column i + k stands for
/// (i + k) mod n, so that periodic splines have the same shape. @pre n >= 6.
class BandMatrix {
 public:
  static constexpr int kHalf = 5;

  BandMatrix() = default;
  BandMatrix(int size, bool cyclic)
      : size_(size), cyclic_(cyclic), data_(static_cast<std::size_t>(size) * (kHalf + 1)) {}

  int size() const { return size_; }
  bool isCyclic() const { return cyclic_; }
  /// The value at (i, i + k), k = 0..5; also stands for the mirrored place. In small cyclic matrices two entries may
  /// name the same place: they add.
  double& entry(int i, int k) { return data_[static_cast<std::size_t>(i) * (kHalf + 1) + static_cast<std::size_t>(k)]; }
  double entry(int i, int k) const {
    return data_[static_cast<std::size_t>(i) * (kHalf + 1) + static_cast<std::size_t>(k)];
  }
  /// += weight * row' row.
  void addOuter(const BandRow& row, double weight);
  /// += factor * other (same size and kind).
  void add(const BandMatrix& other, double factor);
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;
  /// The open matrix of `count` unknowns from `first` on (modulo n), without what couples them to the others. Cyclic
  /// matrices: count <= n - 5.
  BandMatrix block(int first, int count) const;

 private:
  int size_ = 0;
  bool cyclic_ = false;
  std::vector<double> data_;
};

/// L D L' factors of a positive definite BandMatrix; linear cost. Cyclic matrices are folded (0, n-1, 1, n-2, ...),
/// which makes them banded with half bandwidth 10.
class BandCholesky {
 public:
  /// @return false if the matrix is not positive definite to machine precision; the object is then useless.
  bool factor(const BandMatrix&);
  void solveInPlace(Eigen::VectorXd& x) const;
  Eigen::VectorXd solve(Eigen::VectorXd b) const {
    solveInPlace(b);
    return b;
  }
  /// The entries of the inverse within the band, as values (never to be added): Takahashi, Fagan & Chin (1973).
  /// Cyclic: @pre n >= 11.
  BandMatrix inverseBand() const;
  /// row A^-1 row', from the band of the inverse.
  static double quadratic(const BandMatrix& inverseBand, const BandRow& row);

 private:
  int place(int index) const;

  int size_ = 0;
  int half_ = 0;
  bool cyclic_ = false;
  std::vector<double> lower_;  ///< Row r: L(r, r-half..r-1), then D(r).
};

}  // namespace batten
