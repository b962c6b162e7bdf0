// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_matrix.h"

#include <algorithm>
#include <array>
#include <cmath>
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

void BandMatrix::addOuter(const BandRow& row, double weight) {
  int i = row.first;
  if (i + 6 <= size_) {
    double* at = &entry(i, 0);
    for (std::size_t a = 0; a < 6; ++a, at += kHalf + 1) {
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

void BandMatrix::add(const BandMatrix& other, double factor) {
  for (std::size_t i = 0; i < data_.size(); ++i) data_[i] += factor * other.data_[i];
}

Eigen::VectorXd BandMatrix::operator*(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size_);
  for (int i = 0; i < size_; ++i) {
    y[i] += entry(i, 0) * x[i];
    for (int k = 1; k <= kHalf; ++k) {
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

BandMatrix BandMatrix::block(int first, int count) const {
  BandMatrix part(count, false);
  for (int i = 0; i < count; ++i) {
    const int from = (first + i) % size_;
    for (int k = 0; k <= kHalf && i + k < count; ++k) part.entry(i, k) = entry(from, k);
  }
  return part;
}

int BandCholesky::place(int index) const {
  if (!cyclic_) return index;
  return index < (size_ + 1) / 2 ? 2 * index : 2 * (size_ - 1 - index) + 1;
}

namespace {

/// L D L' in place, rows of kBand + 1 numbers. Column r - kBand + j of row r stands at j.
template <int kBand>
bool factorRows(std::vector<double>& lower, int size) {
  constexpr int kWidth = kBand + 1;
  std::array<double, kBand> scaled{};  // L(r,k) D(k) of the row at work
  for (int r = 0; r < size; ++r) {
    double* row = &lower[static_cast<std::size_t>(r) * kWidth];
    const int begin = std::max(0, kBand - r);
    const double original = row[kBand];
    double diagonal = original;
    const auto column = [&](int j, int from) {
      const double* other = row - static_cast<std::ptrdiff_t>(kBand - j) * kWidth;
      double sum = row[j];
      for (int i = from; i < j; ++i) sum -= scaled[i] * other[kBand - j + i];
      scaled[j] = sum;
      const double l = sum / other[kBand];
      row[j] = l;
      diagonal -= l * sum;
    };
    if (begin == 0) {  // the usual case, with loops of known lengths
      for (int j = 0; j < kBand; ++j) column(j, 0);
    } else {
      for (int j = begin; j < kBand; ++j) column(j, begin);
    }
    if (!(diagonal > 1e-15 * std::abs(original)) || !std::isfinite(diagonal)) return false;
    row[kBand] = diagonal;
  }
  return true;
}

template <int kBand>
void solveRows(const std::vector<double>& lower, int size, double* y) {
  constexpr int kWidth = kBand + 1;
  for (int r = 0; r < size; ++r) {
    const double* row = &lower[static_cast<std::size_t>(r) * kWidth];
    double sum = y[r];
    for (int j = std::max(0, kBand - r); j < kBand; ++j) sum -= row[j] * y[r - kBand + j];
    y[r] = sum;
  }
  for (int r = 0; r < size; ++r) y[r] /= lower[static_cast<std::size_t>(r) * kWidth + kBand];
  for (int r = size - 1; r >= 0; --r) {
    const double* row = &lower[static_cast<std::size_t>(r) * kWidth];
    for (int j = std::max(0, kBand - r); j < kBand; ++j) y[r - kBand + j] -= row[j] * y[r];
  }
}

/// Z(i, i + k) at i * width + k: Z = D^-1 L^-1 + (I - L') Z, read within the band from the last row up.
template <int kBand>
std::vector<double> inverseRows(const std::vector<double>& lower, int size) {
  constexpr int kWidth = kBand + 1;
  std::vector<double> z(lower.size(), 0.0);
  for (int i = size - 1; i >= 0; --i) {
    const int reach = std::min(size - 1 - i, kBand);
    double* own = &z[static_cast<std::size_t>(i) * kWidth];
    std::array<double, kWidth> l{};  // L(i + m, i)
    for (int m = 1; m <= reach; ++m)
      l[m] = lower[static_cast<std::size_t>(i + m) * kWidth + static_cast<std::size_t>(kBand - m)];
    for (int j = reach; j >= 1; --j) {
      double sum = 0.0;
      const double* below = own + static_cast<std::ptrdiff_t>(j) * kWidth;
      for (int m = 1; m < j; ++m) sum -= l[m] * own[static_cast<std::ptrdiff_t>(m) * kWidth + j - m];
      for (int m = j; m <= reach; ++m) sum -= l[m] * below[m - j];
      own[j] = sum;
    }
    double sum = 1.0 / lower[static_cast<std::size_t>(i) * kWidth + static_cast<std::size_t>(kBand)];
    for (int m = 1; m <= reach; ++m) sum -= l[m] * own[m];
    own[0] = sum;
  }
  return z;
}

}  // namespace

bool BandCholesky::factor(const BandMatrix& matrix) {
  size_ = matrix.size();
  cyclic_ = matrix.isCyclic();
  half_ = cyclic_ ? 2 * BandMatrix::kHalf : BandMatrix::kHalf;
  const auto width = static_cast<std::size_t>(half_ + 1);
  lower_.assign(static_cast<std::size_t>(size_) * width, 0.0);
  for (int i = 0; i < size_; ++i) {
    for (int k = 0; k <= BandMatrix::kHalf; ++k) {
      if (!cyclic_ && i + k >= size_) break;
      const int p = place(i), q = place((i + k) % size_);
      const int row = std::max(p, q), column = std::min(p, q);
      lower_[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(half_ - row + column)] +=
          matrix.entry(i, k);
    }
  }
  return cyclic_ ? factorRows<2 * BandMatrix::kHalf>(lower_, size_) : factorRows<BandMatrix::kHalf>(lower_, size_);
}

void BandCholesky::solveInPlace(Eigen::VectorXd& x) const {
  if (!cyclic_) return solveRows<BandMatrix::kHalf>(lower_, size_, x.data());
  Eigen::VectorXd folded(size_);
  for (int i = 0; i < size_; ++i) folded[place(i)] = x[i];
  solveRows<2 * BandMatrix::kHalf>(lower_, size_, folded.data());
  for (int i = 0; i < size_; ++i) x[i] = folded[place(i)];
}

BandMatrix BandCholesky::inverseBand() const {
  const std::vector<double> z =
      cyclic_ ? inverseRows<2 * BandMatrix::kHalf>(lower_, size_) : inverseRows<BandMatrix::kHalf>(lower_, size_);
  const auto width = static_cast<std::size_t>(half_ + 1);
  BandMatrix inverse(size_, cyclic_);
  for (int i = 0; i < size_; ++i) {
    for (int k = 0; k <= BandMatrix::kHalf; ++k) {
      if (!cyclic_ && i + k >= size_) break;
      const int p = place(i), q = place((i + k) % size_);
      inverse.entry(i, k) =
          z[static_cast<std::size_t>(std::min(p, q)) * width + static_cast<std::size_t>(std::abs(p - q))];
    }
  }
  return inverse;
}

double BandCholesky::quadratic(const BandMatrix& inverseBand, const BandRow& row) {
  const int n = inverseBand.size();
  double sum = 0.0;
  for (std::size_t a = 0; a < 6; ++a) {
    int i = row.first + static_cast<int>(a);
    if (i >= n) i -= n;
    sum += row.v[a] * row.v[a] * inverseBand.entry(i, 0);
    for (std::size_t b = a + 1; b < 6; ++b) {
      sum += 2.0 * row.v[a] * row.v[b] * inverseBand.entry(i, static_cast<int>(b - a));
    }
  }
  return sum;
}

}  // namespace batten
