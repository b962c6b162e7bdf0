// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_least_squares.h"

#include <algorithm>
#include <cmath>

namespace batten {

BandedLeastSquares::BandedLeastSquares(int unknowns, int width, bool cyclic)
    : unknowns_(unknowns), band_(std::min(unknowns, cyclic ? 2 * width : width)), cyclic_(cyclic) {
  factor_.assign(std::ptrdiff_t{unknowns_} * band_, 0.0);
  right_.assign(unknowns_, Vec2::Zero());
  work_.assign(unknowns_ + 2 * band_, 0.0);
}

void BandedLeastSquares::add(int first, std::span<const double> values, const Vec2& right) {
  int low = unknowns_, high = -1;
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (values[j] == 0.0) continue;
    const int at = place(first + static_cast<int>(j));
    low = std::min(low, at);
    high = std::max(high, at);
    work_[at] += values[j];
  }
  Vec2 rest = right;
  // Each rotation clears the row's first entry against the triangle; what is left starts one column later.
  for (int row = low; row <= high; ++row) {
    const double below = work_[row];
    work_[row] = 0.0;
    if (below == 0.0) continue;
    const double above = factor(row, 0);
    const double length = std::hypot(above, below);
    const double c = above / length, s = below / length;
    factor(row, 0) = length;
    const int reach = std::min(band_, unknowns_ - row);
    for (int k = 1; k < reach; ++k) {
      double& top = factor(row, k);
      double& bottom = work_[row + k];
      const double turned = c * top + s * bottom;
      bottom = c * bottom - s * top;
      top = turned;
    }
    Vec2& topRight = right_[row];
    const Vec2 turnedRight = c * topRight + s * rest;
    rest = c * rest - s * topRight;
    topRight = turnedRight;
    high = std::max(high, row + reach - 1);
  }
}

std::optional<std::vector<Vec2>> BandedLeastSquares::solve() const {
  double largest = 0.0;
  for (int r = 0; r < unknowns_; ++r) largest = std::max(largest, std::abs(factor(r, 0)));
  std::vector<Vec2> x(unknowns_);
  for (int r = unknowns_ - 1; r >= 0; --r) {
    const double diagonal = factor(r, 0);
    if (!(std::abs(diagonal) > 1e-14 * largest)) return std::nullopt;
    Vec2 sum = right_[r];
    for (int k = 1; k < band_ && r + k < unknowns_; ++k) sum -= factor(r, k) * x[r + k];
    x[r] = sum / diagonal;
    if (!x[r].allFinite()) return std::nullopt;
  }
  if (!cyclic_) return x;
  std::vector<Vec2> unfolded(x.size());
  for (int i = 0; i < unknowns_; ++i) unfolded[i] = x[place(i)];
  return unfolded;
}

}  // namespace batten
