// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/column_cholesky.h"

#include <cmath>

namespace batten {
namespace {

using Column = Eigen::Map<Eigen::ArrayXd>;
using ConstColumn = Eigen::Map<const Eigen::ArrayXd>;

}  // namespace

bool ColumnCholesky::factor(const BandedMatrix& matrix, double leastPivot) {
  size_ = matrix.size();
  band_ = matrix.halfWidth();
  lower_.resize(std::ptrdiff_t{size_} * (band_ + 1));
  for (int c = 0; c < size_; ++c)
    for (int k = 0; k <= below(c); ++k) column(c)[k] = matrix.entry(c, k);
  a_.resize(band_);
  b_.resize(band_);
  const auto isPivot = [&](int c) {
    const double pivot = *column(c);
    return pivot > leastPivot * std::abs(matrix.entry(c, 0)) && std::isfinite(pivot);
  };
  for (int c = 0; c < size_; c += 2) {
    if (!isPivot(c)) return false;
    if (c + 1 == size_) {
      Column(column(c) + 1, below(c)) /= *column(c);
      break;
    }
    double *first = column(c), *second = column(c + 1);
    Column(second, below(c)) -= first[1] / first[0] * ConstColumn(first + 1, below(c));
    if (!isPivot(c + 1)) return false;
    eliminate(c, first, second);
  }
  return true;
}

/// Takes two columns, of which the second has had the first taken from it, from all to the right of them, which are so
/// read and written once for both.
void ColumnCholesky::eliminate(int c, double* first, double* second) {
  const int belowFirst = below(c), belowSecond = below(c + 1), shared = std::max(belowFirst - 1, 0);
  a_.setZero();
  a_.head(shared) = ConstColumn(first + 2, shared);
  b_.head(belowSecond) = ConstColumn(second + 1, belowSecond);
  Column(first + 1, belowFirst) /= first[0];
  Column(second + 1, belowSecond) /= second[0];
  for (int k = 0; k < belowSecond; ++k) {
    const int rest = belowSecond - k;
    const double fromFirst = k < shared ? first[k + 2] : 0.0, fromSecond = second[k + 1];
    Column(column(c + 2 + k), rest) -= fromFirst * a_.segment(k, rest) + fromSecond * b_.segment(k, rest);
  }
}

void ColumnCholesky::solveInPlace(Eigen::VectorXd& x) const {
  double* y = x.data();
  for (int c = 0; c < size_; ++c) Column(y + c + 1, below(c)) -= y[c] * ConstColumn(column(c) + 1, below(c));
  for (int c = 0; c < size_; ++c) y[c] /= *column(c);
  for (int c = size_ - 1; c >= 0; --c)
    y[c] -= ConstColumn(column(c) + 1, below(c)).matrix().dot(ConstColumn(y + c + 1, below(c)).matrix());
}

}  // namespace batten
