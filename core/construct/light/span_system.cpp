// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/span_system.h"

namespace batten {

void SpanSystem::add(const PlaceTable::Place& place, const PlaceState& state, const DerivativeGradients& gradients,
                     double weight, double residual) {
  WeighedRow& one = rows_.emplace_back();
  one.weight = weight;
  one.residual = residual;
  one.row.fill(0.0);
  double scale = 1.0, byOwn = 0.0;
  for (std::size_t order = 0; order < 4; ++order) {
    const Vec2& g = gradients[order];
    if (g.x() != 0.0 || g.y() != 0.0) {
      const double x = scale * g.x(), y = scale * g.y();
      const double* values = place.pairs[order].data();
      for (std::size_t k = 0; k < 2 * kSpanPoints; k += 2) {
        one.row[k] += x * values[k];
        one.row[k + 1] += y * values[k + 1];
      }
      byOwn -= static_cast<double>(order) * g.dot(state.d[order]);
    }
    scale /= length;
  }
  if (lengthCount > 0) one.row[2 * degree + 2] = byOwn;
}

void SpanSystem::carryGradient() {
  const int points = degree + 1;
  for (int j = 0; j < points; ++j) {
    double x = 0.0, y = 0.0;
    for (int k = 0; k < points; ++k) {
      const double part = dependence.byPoint[k][j];
      x += part * local_.gradient[2 * k];
      y += part * local_.gradient[2 * k + 1];
    }
    gradient_[j] = x;
    gradient_[kXLanes + j] = y;
  }
  for (int i = 0; i < lengthCount; ++i) {
    double sum = i == ownLength ? local_.gradient[2 * points] : 0.0;
    for (int k = 0; k < points; ++k) {
      sum +=
          dependence.xByLength[k][i] * local_.gradient[2 * k] + dependence.yByLength[k][i] * local_.gradient[2 * k + 1];
    }
    gradient_[2 * kXLanes + i] = sum;
  }
}

void SpanSystem::sumAndCarry() {
  const int count = 2 * (degree + 1) + (lengthCount > 0 ? 1 : 0);
  sumRows(rows_.data(), static_cast<int>(rows_.size()), count, local_);
  if (lengthCount == 0) {
    for (int c = 0; c < count; ++c) {
      for (int r = c; r < count; ++r) squares_[lane(r)][lane(c)] = local_.squares[c][r];
      gradient_[lane(c)] = local_.gradient[c];
    }
    return;
  }
  for (int c = 0; c < count; ++c) {
    for (int r = c + 1; r < count; ++r) local_.squares[r][c] = local_.squares[c][r];
  }
  carrySquares(local_, dependence, degree + 1, lengthCount, ownLength, squares_);
  carryGradient();
}

}  // namespace batten
