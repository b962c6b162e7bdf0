// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/banded_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace batten {

double dot(const BandRow& row, const Eigen::VectorXd& x) {
  const int n = static_cast<int>(x.size());
  double sum = 0.0;
  int column = row.first;
  for (const double v : row.v) {
    if (column >= n) column -= n;
    sum += v * x[column++];
  }
  return sum;
}

void addTo(Eigen::VectorXd& x, const BandRow& row, double factor) {
  const int n = static_cast<int>(x.size());
  int column = row.first;
  for (const double v : row.v) {
    if (column >= n) column -= n;
    x[column++] += factor * v;
  }
}

void BandMatrix::addOuter(const BandRow& row, double weight) {
  int i = row.first;
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
  std::vector<double> scaled(width);  // L(r,k) D(k) of the row at work
  for (int r = 0; r < size_; ++r) {
    double* row = &lower_[static_cast<std::size_t>(r) * width];
    const int begin = std::max(0, r - half_);
    const double original = row[half_];
    double diagonal = original;
    for (int c = begin; c < r; ++c) {
      const double* other = &lower_[static_cast<std::size_t>(c) * width];
      const int shift = r - c;  // column k sits at half - r + k here and at half - c + k there
      double sum = row[half_ - r + c];
      for (int at = std::max(half_ - r + begin, 0); at < half_ - shift; ++at) {
        sum -= scaled[static_cast<std::size_t>(at)] * other[at + shift];
      }
      const auto here = static_cast<std::size_t>(half_ - shift);
      scaled[here] = sum;
      const double l = sum / other[half_];
      row[here] = l;
      diagonal -= l * sum;
    }
    if (!(diagonal > 1e-15 * std::abs(original)) || !std::isfinite(diagonal)) return false;
    row[half_] = diagonal;
  }
  return true;
}

void BandCholesky::solveInPlace(Eigen::VectorXd& x) const {
  const auto width = static_cast<std::size_t>(half_ + 1);
  Eigen::VectorXd folded;
  if (cyclic_) {
    folded.resize(size_);
    for (int i = 0; i < size_; ++i) folded[place(i)] = x[i];
  }
  Eigen::VectorXd& y = cyclic_ ? folded : x;
  for (int r = 0; r < size_; ++r) {
    const double* row = &lower_[static_cast<std::size_t>(r) * width];
    double sum = y[r];
    for (int c = std::max(0, r - half_); c < r; ++c) sum -= row[half_ - r + c] * y[c];
    y[r] = sum;
  }
  for (int r = size_ - 1; r >= 0; --r) {
    const double* row = &lower_[static_cast<std::size_t>(r) * width];
    y[r] /= row[half_];
    for (int k = r + 1; k <= std::min(size_ - 1, r + half_); ++k) {
      y[r] -= lower_[static_cast<std::size_t>(k) * width + static_cast<std::size_t>(half_ - k + r)] * y[k];
    }
  }
  if (cyclic_) {
    for (int i = 0; i < size_; ++i) x[i] = folded[place(i)];
  }
}

BandMatrix BandCholesky::inverseBand() const {
  const auto width = static_cast<std::size_t>(half_ + 1);
  // Z(i, i + k) at i * width + k, in folded order: Z = D^-1 L^-1 + (I - L') Z, read within the band from the last row
  // up.
  std::vector<double> z(lower_.size(), 0.0);
  const auto zAt = [&](int i, int j) -> double& {
    return z[static_cast<std::size_t>(std::min(i, j)) * width + static_cast<std::size_t>(std::abs(i - j))];
  };
  for (int i = size_ - 1; i >= 0; --i) {
    const int end = std::min(size_ - 1, i + half_);
    for (int j = end; j >= i; --j) {
      double sum = i == j ? 1.0 / lower_[static_cast<std::size_t>(i) * width + static_cast<std::size_t>(half_)] : 0.0;
      for (int k = i + 1; k <= end; ++k) {
        sum -= lower_[static_cast<std::size_t>(k) * width + static_cast<std::size_t>(half_ - k + i)] * zAt(k, j);
      }
      zAt(i, j) = sum;
    }
  }
  BandMatrix inverse(size_, cyclic_);
  for (int i = 0; i < size_; ++i) {
    for (int k = 0; k <= BandMatrix::kHalf; ++k) {
      if (!cyclic_ && i + k >= size_) break;
      inverse.entry(i, k) = zAt(place(i), place((i + k) % size_));
    }
  }
  return inverse;
}

double BandCholesky::quadratic(const BandMatrix& inverseBand, const BandRow& row) {
  const int n = inverseBand.size();
  double sum = 0.0;
  for (std::size_t a = 0; a < 6; ++a) {
    const int i = (row.first + static_cast<int>(a)) % n;
    sum += row.v[a] * row.v[a] * inverseBand.entry(i, 0);
    for (std::size_t b = a + 1; b < 6; ++b) {
      sum += 2.0 * row.v[a] * row.v[b] * inverseBand.entry(i, static_cast<int>(b - a));
    }
  }
  return sum;
}

}  // namespace batten
