// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_cholesky.h"

#include <algorithm>
#include <cmath>

namespace batten {

void BandedMatrix::add(const BandedMatrix& other, double factor) {
  for (std::size_t i = 0; i < data_.size(); ++i) data_[i] += factor * other.data_[i];
}

bool BandedMatrix::factorize() {
  for (int j = 0; j < size_; ++j) {
    double* column = &data_[offset(j, j)];
    if (!(column[0] > 0.0) || !std::isfinite(column[0])) return false;
    const double pivot = std::sqrt(column[0]), inverse = 1.0 / pivot;
    column[0] = pivot;
    const int below = std::min(halfWidth_, size_ - 1 - j);
    for (int k = 1; k <= below; ++k) column[k] *= inverse;
    for (int k = 1; k <= below; ++k) {
      const double factor = column[k];
      double* target = &data_[offset(j + k, j + k)];
      for (int l = k; l <= below; ++l) target[l - k] -= factor * column[l];
    }
  }
  return true;
}

void BandedMatrix::solve(Eigen::VectorXd& x) const {
  for (int j = 0; j < size_; ++j) {
    const double* column = &data_[offset(j, j)];
    const double value = x[j] /= column[0];
    const int below = std::min(halfWidth_, size_ - 1 - j);
    for (int k = 1; k <= below; ++k) x[j + k] -= column[k] * value;
  }
  for (int j = size_ - 1; j >= 0; --j) {
    const double* column = &data_[offset(j, j)];
    const int below = std::min(halfWidth_, size_ - 1 - j);
    double value = x[j];
    for (int k = 1; k <= below; ++k) value -= column[k] * x[j + k];
    x[j] = value / column[0];
  }
}

}  // namespace batten
