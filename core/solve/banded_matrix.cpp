// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_matrix.h"

#include <algorithm>
#include <cstddef>

#include "core/base/hot_loop.h"

namespace batten {

double dot(const BandRow& row, const Eigen::VectorXd& x) {
  const int n = static_cast<int>(x.size());
  double sum = 0.0;
  if (row.first + 6 <= n) {  // the usual case
    const double* at = x.data() + row.first;
    for (std::size_t i = 0; i < 6; ++i) sum += row.v[i] * at[i];
    return sum;
  }
  int column = row.first;
  for (const double v : row.v) {
    if (column >= n) column -= n;
    sum += v * x[column++];
  }
  return sum;
}

void addTo(Eigen::VectorXd& x, const BandRow& row, double factor) {
  const int n = static_cast<int>(x.size());
  if (row.first + 6 <= n) {
    const auto values = row.v;  // so that no entry can be one of them
    double* at = x.data() + row.first;
    for (std::size_t i = 0; i < 6; ++i) at[i] += factor * values[i];
    return;
  }
  int column = row.first;
  for (const double v : row.v) {
    if (column >= n) column -= n;
    x[column++] += factor * v;
  }
}

void BandedMatrix::addOuter(const BandRow& row, double weight) {
  int i = row.first;
  if (i + 6 <= size_) {
    const auto values = row.v;  // so that no entry can be one of them
    double* at = &entry(i, 0);
    BATTEN_UNROLL
    for (std::size_t a = 0; a < 6; ++a, at += halfWidth_ + 1) {
      const double weighed = weight * values[a];
      BATTEN_UNROLL
      for (std::size_t b = a; b < 6; ++b) at[b - a] += weighed * values[b];
    }
    return;
  }
  for (std::size_t a = 0; a < 6; ++a, ++i) {
    if (i >= size_) i -= size_;
    const double wv = weight * row.v[a];
    for (std::size_t b = a; b < 6; ++b) entry(i, static_cast<int>(b - a)) += wv * row.v[b];
  }
}

void BandedMatrix::add(const BandedMatrix& other, double factor) {
  for (std::size_t i = 0; i < data_.size(); ++i) data_[i] += factor * other.data_[i];
}

void BandedMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.setZero(size_);
  const double* row = data_.data();
  const int inside = std::max(0, size_ - halfWidth_);
  for (int i = 0; i < inside; ++i, row += halfWidth_ + 1) {  // the usual case
    double own = y[i] + row[0] * x[i];
    for (int k = 1; k <= halfWidth_; ++k) {
      own += row[k] * x[i + k];
      y[i + k] += row[k] * x[i];
    }
    y[i] = own;
  }
  for (int i = inside; i < size_; ++i, row += halfWidth_ + 1) {
    y[i] += row[0] * x[i];
    for (int k = 1; k <= halfWidth_; ++k) {
      int j = i + k;
      if (j >= size_) {
        if (!cyclic_) break;
        j -= size_;
      }
      y[i] += row[k] * x[j];
      y[j] += row[k] * x[i];
    }
  }
}

BandedMatrix BandedMatrix::block(int first, int count) const {
  BandedMatrix part(count, halfWidth_, false);
  for (int i = 0; i < count; ++i) {
    const int from = (first + i) % size_;
    for (int k = 0; k <= halfWidth_ && i + k < count; ++k) part.entry(i, k) = entry(from, k);
  }
  return part;
}

}  // namespace batten
