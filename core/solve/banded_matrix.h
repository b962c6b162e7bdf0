// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace batten {

/// Six consecutive numbers of a row of a quintic spline's system; columns first..first+5, modulo the number of
/// unknowns.
struct BandRow {
  static constexpr int kHalfWidth = 5;  ///< Of the matrices that such rows make.
  int first = 0;                        ///< Column of v[0].
  std::array<double, kHalfWidth + 1> v{};
};

/// row . x, with column numbers modulo the size of x.
double dot(const BandRow& row, const Eigen::VectorXd& x);
/// x += factor * row'.
void addTo(Eigen::VectorXd& x, const BandRow& row, double factor);

/// Where unknown `index` of `count` in a ring goes when the ring is folded flat (0, n-1, 1, n-2, ...): what lay within
/// w of each other around the ring then lies within 2 w.
constexpr int foldedPlace(int index, int count) { return 2 * index < count ? 2 * index : 2 * (count - 1 - index) + 1; }

/// Symmetric matrix whose entries lie within `halfWidth` of the diagonal. Cyclic: column i + k stands for (i + k) mod
/// n, so that periodic splines have the same shape. @pre size > halfWidth.
class BandedMatrix {
 public:
  BandedMatrix() = default;
  BandedMatrix(int size, int halfWidth, bool cyclic)
      : size_(size), halfWidth_(halfWidth), cyclic_(cyclic), data_(std::ptrdiff_t{size} * (halfWidth + 1)) {}

  int size() const { return size_; }
  int halfWidth() const { return halfWidth_; }
  bool isCyclic() const { return cyclic_; }
  /// The value at (i, i + k), k = 0..halfWidth; also stands for the mirrored place. In small cyclic matrices two
  /// entries may name the same place: they add.
  double& entry(int i, int k) { return data_[offset(i, k)]; }
  double entry(int i, int k) const { return data_[offset(i, k)]; }
  /// += weight * row' row.
  void addOuter(const BandRow& row, double weight);
  /// += factor * other (same size and kind).
  void add(const BandedMatrix& other, double factor);
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const {
    Eigen::VectorXd y;
    multiply(x, y);
    return y;
  }
  /// y = this x, in memory that the caller keeps from step to step.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// The open matrix of `count` unknowns from `first` on (modulo n), without what couples them to the others. Cyclic
  /// matrices: count <= n - halfWidth.
  BandedMatrix block(int first, int count) const;

 private:
  std::size_t offset(int i, int k) const { return std::ptrdiff_t{i} * (halfWidth_ + 1) + k; }
  int size_ = 0, halfWidth_ = 0;
  bool cyclic_ = false;
  std::vector<double> data_;
};

}  // namespace batten
