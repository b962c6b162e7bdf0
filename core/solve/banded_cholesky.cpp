// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_cholesky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace batten {
namespace {

/// The half width of a factor: a number that the compiler knows, for the matrices of quintic splines, so that its loops
/// are unrolled; else Eigen::Dynamic, and the number itself beside it.
constexpr int kOpenSpline = BandRow::kHalfWidth, kCyclicSpline = 2 * BandRow::kHalfWidth;

template <int kKnown>
using BandBuffer =
    std::conditional_t<kKnown == Eigen::Dynamic, std::vector<double>, std::array<double, std::max(kKnown, 0) + 1>>;

template <int kKnown>
BandBuffer<kKnown> bandBuffer(int band) {
  BandBuffer<kKnown> buffer{};
  if constexpr (kKnown == Eigen::Dynamic) buffer.resize(band + 1);
  return buffer;
}

/// start - a . b; of unknown length by vector instructions.
template <int kKnown>
double minusDot(double start, const double* a, const double* b, int count) {
  if constexpr (kKnown == Eigen::Dynamic) {
    using Values = Eigen::Map<const Eigen::VectorXd>;
    return start - Values(a, count).dot(Values(b, count));
  }
  for (int i = 0; i < count; ++i) start -= a[i] * b[i];
  return start;
}

/// L D L' in place, rows of band + 1 numbers. Column r - band + j of row r stands at j.
template <int kKnown>
bool factorRows(std::vector<double>& lower, int size, int halfWidth, double leastPivot) {
  const int band = kKnown == Eigen::Dynamic ? halfWidth : kKnown;
  const auto width = static_cast<std::ptrdiff_t>(band) + 1;
  auto scaled = bandBuffer<kKnown>(band);  // L(r,k) D(k) of the row at work
  for (int r = 0; r < size; ++r) {
    double* row = lower.data() + r * width;
    const int begin = std::max(0, band - r);
    const double original = row[band];
    double diagonal = original;
    const auto column = [&](int j, int from) {
      const double* other = row - (band - j) * width;
      const double sum = minusDot<kKnown>(row[j], scaled.data() + from, other + band - j + from, j - from);
      scaled[j] = sum;
      const double l = sum / other[band];
      row[j] = l;
      diagonal -= l * sum;
    };
    if (begin == 0) {  // the usual case, with loops of known lengths
      for (int j = 0; j < band; ++j) column(j, 0);
    } else {
      for (int j = begin; j < band; ++j) column(j, begin);
    }
    if (!(diagonal > leastPivot * std::abs(original)) || !std::isfinite(diagonal)) return false;
    row[band] = diagonal;
  }
  return true;
}

template <int kKnown>
void solveRows(const std::vector<double>& lower, int size, int halfWidth, double* y) {
  const int band = kKnown == Eigen::Dynamic ? halfWidth : kKnown;
  const auto width = static_cast<std::ptrdiff_t>(band) + 1;
  for (int r = 0; r < size; ++r) {
    const int begin = std::max(0, band - r);
    y[r] = minusDot<kKnown>(y[r], lower.data() + r * width + begin, y + r - band + begin, band - begin);
  }
  for (int r = 0; r < size; ++r) y[r] /= lower[r * width + band];
  for (int r = size - 1; r >= 0; --r) {
    const double* row = lower.data() + r * width;
    for (int j = std::max(0, band - r); j < band; ++j) y[r - band + j] -= row[j] * y[r];
  }
}

/// Z(i, i + k) at i * width + k: Z = D^-1 L^-1 + (I - L') Z, read within the band from the last row up.
template <int kKnown>
std::vector<double> inverseRows(const std::vector<double>& lower, int size, int halfWidth) {
  const int band = kKnown == Eigen::Dynamic ? halfWidth : kKnown;
  const auto width = static_cast<std::ptrdiff_t>(band) + 1;
  std::vector<double> z(lower.size(), 0.0);
  for (int i = size - 1; i >= 0; --i) {
    const int reach = std::min(size - 1 - i, band);
    double* own = z.data() + i * width;
    auto l = bandBuffer<kKnown>(band);  // L(i + m, i)
    for (int m = 1; m <= reach; ++m) l[m] = lower[(i + m) * width + band - m];
    for (int j = reach; j >= 1; --j) {
      double sum = 0.0;
      const double* below = own + j * width;
      for (int m = 1; m < j; ++m) sum -= l[m] * own[m * width + j - m];
      for (int m = j; m <= reach; ++m) sum -= l[m] * below[m - j];
      own[j] = sum;
    }
    double sum = 1.0 / lower[i * width + band];
    for (int m = 1; m <= reach; ++m) sum -= l[m] * own[m];
    own[0] = sum;
  }
  return z;
}

/// Calls `body` with the half width as a constant where the compiler knows it.
template <class Body>
auto withBand(int band, const Body& body) {
  switch (band) {
    case kOpenSpline:
      return body(std::integral_constant<int, kOpenSpline>());
    case kCyclicSpline:
      return body(std::integral_constant<int, kCyclicSpline>());
    default:
      return body(std::integral_constant<int, Eigen::Dynamic>());
  }
}

}  // namespace

bool BandedCholesky::factor(const BandedMatrix& matrix, double leastPivot) {
  size_ = matrix.size();
  halfWidth_ = matrix.halfWidth();
  cyclic_ = matrix.isCyclic();
  band_ = cyclic_ ? 2 * halfWidth_ : halfWidth_;
  const auto width = static_cast<std::ptrdiff_t>(band_) + 1;
  if (cyclic_) {
    lower_.assign(size_ * width, 0.0);
    for (int i = 0; i < size_; ++i) {
      for (int k = 0; k <= halfWidth_; ++k) {
        const int p = place(i), q = place(i + k < size_ ? i + k : i + k - size_);
        const int row = std::max(p, q), column = std::min(p, q);
        lower_[row * width + band_ - row + column] += matrix.entry(i, k);
      }
    }
  } else {
    lower_.resize(size_ * width);
    double* row = lower_.data();
    for (int r = 0; r < size_; ++r, row += width) {
      for (int j = 0; j <= band_; ++j) row[j] = r - band_ + j < 0 ? 0.0 : matrix.entry(r - band_ + j, band_ - j);
    }
  }
  return withBand(band_, [&](auto known) { return factorRows<known()>(lower_, size_, band_, leastPivot); });
}

void BandedCholesky::solveInPlace(Eigen::VectorXd& x) const {
  const auto solve = [&](double* y) {
    withBand(band_, [&](auto known) { solveRows<known()>(lower_, size_, band_, y); });
  };
  if (!cyclic_) return solve(x.data());
  Eigen::VectorXd folded(size_);
  for (int i = 0; i < size_; ++i) folded[place(i)] = x[i];
  solve(folded.data());
  for (int i = 0; i < size_; ++i) x[i] = folded[place(i)];
}

BandedMatrix BandedCholesky::inverseBand() const {
  const std::vector<double> z = withBand(band_, [&](auto known) { return inverseRows<known()>(lower_, size_, band_); });
  const auto width = static_cast<std::ptrdiff_t>(band_) + 1;
  BandedMatrix inverse(size_, halfWidth_, cyclic_);
  for (int i = 0; i < size_; ++i) {
    for (int k = 0; k <= halfWidth_; ++k) {
      if (!cyclic_ && i + k >= size_) break;
      const int p = place(i), q = place(i + k < size_ ? i + k : i + k - size_);
      inverse.entry(i, k) = z[std::min(p, q) * width + std::abs(p - q)];
    }
  }
  return inverse;
}

double BandedCholesky::quadratic(const BandedMatrix& inverseBand, const BandRow& row) {
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
