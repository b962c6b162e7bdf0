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
/// are unrolled; these are stored and gone through by rows. Else Eigen::Dynamic, and the number itself beside it; these
/// by columns, below the diagonal, where vector instructions serve wide bands better.
constexpr int kOpenSpline = BandRow::kHalfWidth, kCyclicSpline = 2 * BandRow::kHalfWidth;

template <int kBand>
using BandBuffer = std::array<double, static_cast<std::size_t>(kBand) + 1>;

/// L D L' in place, rows of band + 1 numbers. Column r - band + j of row r stands at j.
template <int kBand>
bool factorRows(std::vector<double>& lower, int size, double leastPivot) {
  constexpr int band = kBand;
  constexpr std::ptrdiff_t width = band + 1;
  BandBuffer<kBand> scaled{};  // L(r,k) D(k) of the row at work
  for (int r = 0; r < size; ++r) {
    double* row = lower.data() + r * width;
    const int begin = std::max(0, band - r);
    const double original = row[band];
    double diagonal = original;
    const auto column = [&](int j, int from) {
      const double* other = row - (band - j) * width;
      double sum = row[j];
      for (int k = from; k < j; ++k) sum -= scaled[k] * other[band - j + k];
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

template <int kBand>
void solveRows(const std::vector<double>& lower, int size, double* y) {
  constexpr int band = kBand;
  constexpr std::ptrdiff_t width = band + 1;
  for (int r = 0; r < size; ++r) {
    const int begin = std::max(0, band - r);
    const double* row = lower.data() + r * width;
    double sum = y[r];
    for (int j = begin; j < band; ++j) sum -= row[j] * y[r - band + j];
    y[r] = sum;
  }
  for (int r = 0; r < size; ++r) y[r] /= lower[r * width + band];
  for (int r = size - 1; r >= 0; --r) {
    const double* row = lower.data() + r * width;
    for (int j = std::max(0, band - r); j < band; ++j) y[r - band + j] -= row[j] * y[r];
  }
}

using Column = Eigen::Map<Eigen::ArrayXd>;
using ConstColumn = Eigen::Map<const Eigen::ArrayXd>;

/// The factor by columns of band + 1 numbers: L(c + k, c) D(c) stands at k of column c while at work, L(c + k, c) in
/// the end, D(c) at 0.
class ColumnFactor {
 public:
  ColumnFactor(std::vector<double>& lower, int size, int band)
      : lower_(lower), size_(size), band_(band), diagonal_(size), a_(band), b_(band) {
    for (int c = 0; c < size; ++c) diagonal_[c] = std::abs(*at(c));
  }

  /// Two columns at a time: what is to the right of them is read and written once for both.
  bool run(double leastPivot) {
    for (int c = 0; c < size_; c += 2) {
      if (!isPivot(c, leastPivot)) return false;
      double* first = at(c);
      const int below = std::min(band_, size_ - 1 - c);
      if (c + 1 == size_) return true;
      double* second = at(c + 1);
      const int belowSecond = std::min(band_, size_ - 2 - c);
      Column(second, below) -= first[1] / first[0] * ConstColumn(first + 1, below);
      if (!isPivot(c + 1, leastPivot)) return false;
      a_.setZero();
      a_.head(std::max(below - 1, 0)) = ConstColumn(first + 2, std::max(below - 1, 0));
      b_.head(belowSecond) = ConstColumn(second + 1, belowSecond);
      Column(first + 1, below) /= first[0];
      Column(second + 1, belowSecond) /= second[0];
      for (int k = 0; k < belowSecond; ++k) {
        const int rest = belowSecond - k;
        const double fromFirst = k + 2 <= below ? first[k + 2] : 0.0, fromSecond = second[k + 1];
        Column(at(c + 2 + k), rest) -= fromFirst * a_.segment(k, rest) + fromSecond * b_.segment(k, rest);
      }
    }
    return true;
  }

 private:
  double* at(int column) { return lower_.data() + std::ptrdiff_t{column} * (band_ + 1); }
  bool isPivot(int column, double least) {
    const double pivot = *at(column);
    return pivot > least * diagonal_[column] && std::isfinite(pivot);
  }

  std::vector<double>& lower_;
  int size_, band_;
  Eigen::ArrayXd diagonal_;  ///< Of the matrix, without sign.
  Eigen::ArrayXd a_, b_;     ///< Two columns as they were, from the second row below the first one's diagonal on.
};

void solveColumns(const std::vector<double>& lower, int size, int band, double* y) {
  const auto columnOf = [&](int c) { return lower.data() + std::ptrdiff_t{c} * (band + 1); };
  const auto belowOf = [&](int c) { return std::min(band, size - 1 - c); };
  for (int c = 0; c < size; ++c) Column(y + c + 1, belowOf(c)) -= y[c] * ConstColumn(columnOf(c) + 1, belowOf(c));
  for (int c = 0; c < size; ++c) y[c] /= *columnOf(c);
  for (int c = size - 1; c >= 0; --c) {
    const int below = belowOf(c);
    y[c] -= ConstColumn(columnOf(c) + 1, below).matrix().dot(ConstColumn(y + c + 1, below).matrix());
  }
}

/// Z(i, i + k) at i * width + k: Z = D^-1 L^-1 + (I - L') Z, read within the band from the last row up.
/// @param below L(i + m, i); @param pivot D(i).
template <int kKnown, class Below, class Pivot>
std::vector<double> inverseRows(int size, int halfWidth, const Below& below, const Pivot& pivot) {
  const int band = kKnown == Eigen::Dynamic ? halfWidth : kKnown;
  const auto width = static_cast<std::ptrdiff_t>(band) + 1;
  std::vector<double> z(static_cast<std::size_t>(size * width), 0.0);
  std::vector<double> l(static_cast<std::size_t>(width));
  for (int i = size - 1; i >= 0; --i) {
    const int reach = std::min(size - 1 - i, band);
    double* own = z.data() + i * width;
    for (int m = 1; m <= reach; ++m) l[m] = below(i, m);
    for (int j = reach; j >= 1; --j) {
      double sum = 0.0;
      const double* other = own + j * width;
      for (int m = 1; m < j; ++m) sum -= l[m] * own[m * width + j - m];
      for (int m = j; m <= reach; ++m) sum -= l[m] * other[m - j];
      own[j] = sum;
    }
    double sum = 1.0 / pivot(i);
    for (int m = 1; m <= reach; ++m) sum -= l[m] * own[m];
    own[0] = sum;
  }
  return z;
}

bool isKnown(int band) { return band == kOpenSpline || band == kCyclicSpline; }

/// Calls `run` with the half width as a constant where the compiler knows it.
template <class Run>
auto withBand(int band, const Run& run) {
  switch (band) {
    case kOpenSpline:
      return run(std::integral_constant<int, kOpenSpline>());
    case kCyclicSpline:
      return run(std::integral_constant<int, kCyclicSpline>());
    default:
      return run(std::integral_constant<int, Eigen::Dynamic>());
  }
}

}  // namespace

bool BandedCholesky::factor(const BandedMatrix& matrix, double leastPivot) {
  size_ = matrix.size();
  halfWidth_ = matrix.halfWidth();
  cyclic_ = matrix.isCyclic();
  band_ = cyclic_ ? 2 * halfWidth_ : halfWidth_;
  const auto width = static_cast<std::ptrdiff_t>(band_) + 1;
  lower_.assign(static_cast<std::size_t>(size_ * width), 0.0);
  const bool byRows = isKnown(band_);
  for (int i = 0; i < size_; ++i) {
    if (!cyclic_ && !byRows) {
      for (int k = 0; k <= halfWidth_ && i + k < size_; ++k) lower_[i * width + k] = matrix.entry(i, k);
      continue;
    }
    for (int k = 0; k <= halfWidth_; ++k) {
      if (!cyclic_ && i + k >= size_) break;
      const int p = place(i), q = place((i + k) % size_);
      const int row = std::max(p, q), column = std::min(p, q);
      lower_[byRows ? row * width + band_ - row + column : column * width + row - column] += matrix.entry(i, k);
    }
  }
  return withBand(band_, [&](auto known) {
    if constexpr (known() == Eigen::Dynamic)
      return ColumnFactor(lower_, size_, band_).run(leastPivot);
    else
      return factorRows<known()>(lower_, size_, leastPivot);
  });
}

void BandedCholesky::solveInPlace(Eigen::VectorXd& x) const {
  const auto solve = [&](double* y) {
    withBand(band_, [&](auto known) {
      if constexpr (known() == Eigen::Dynamic)
        solveColumns(lower_, size_, band_, y);
      else
        solveRows<known()>(lower_, size_, y);
    });
  };
  if (!cyclic_) return solve(x.data());
  Eigen::VectorXd folded(size_);
  for (int i = 0; i < size_; ++i) folded[place(i)] = x[i];
  solve(folded.data());
  for (int i = 0; i < size_; ++i) x[i] = folded[place(i)];
}

BandedMatrix BandedCholesky::inverseBand() const {
  const auto width = static_cast<std::ptrdiff_t>(band_) + 1;
  const bool byRows = isKnown(band_);
  const auto below = [&](int i, int m) { return lower_[byRows ? (i + m) * width + band_ - m : i * width + m]; };
  const auto pivot = [&](int i) { return lower_[i * width + (byRows ? band_ : 0)]; };
  const std::vector<double> z =
      withBand(band_, [&](auto known) { return inverseRows<known()>(size_, band_, below, pivot); });
  BandedMatrix inverse(size_, halfWidth_, cyclic_);
  for (int i = 0; i < size_; ++i) {
    for (int k = 0; k <= halfWidth_; ++k) {
      if (!cyclic_ && i + k >= size_) break;
      const int p = place(i), q = place((i + k) % size_);
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
