// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_matrix.h"

#include <cstddef>

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
    double* at = x.data() + row.first;
    for (std::size_t i = 0; i < 6; ++i) at[i] += factor * row.v[i];
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
    double* at = &entry(i, 0);
    for (std::size_t a = 0; a < 6; ++a, at += halfWidth_ + 1) {
      const double wv = weight * row.v[a];
      for (std::size_t b = a; b < 6; ++b) at[b - a] += wv * row.v[b];
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

Eigen::VectorXd BandedMatrix::operator*(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size_);
  for (int i = 0; i < size_; ++i) {
    y[i] += entry(i, 0) * x[i];
    for (int k = 1; k <= halfWidth_; ++k) {
      int j = i + k;
      if (j >= size_) {
        if (!cyclic_) break;
        j -= size_;
      }
      const double v = entry(i, k);
      y[i] += v * x[j];
      y[j] += v * x[i];
    }
  }
  return y;
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
