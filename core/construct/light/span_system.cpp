// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/span_system.h"

namespace batten {

void SpanSystem::begin() {
  used = 2 * (degree + 1) + lengthCount;
  for (LocalRow& column : local_) column.fill(0.0);
  localGradient_.fill(0.0);
}

SpanSystem::LocalRow SpanSystem::rowOf(const PlaceTable::Place& place, const PlaceState& state,
                                       const DerivativeGradients& gradients) const {
  LocalRow row{};
  const std::size_t points = static_cast<std::size_t>(degree) + 1;
  double scale = 1.0, byOwn = 0.0;
  for (std::size_t order = 0; order < 4; ++order) {
    const Vec2& g = gradients[order];
    if (g.x() != 0.0 || g.y() != 0.0) {
      const double x = scale * g.x(), y = scale * g.y();
      for (std::size_t k = 0; k < points; ++k) {
        row[2 * k] += x * place.rows[order][k];
        row[2 * k + 1] += y * place.rows[order][k];
      }
      byOwn -= static_cast<double>(order) * g.dot(state.d[order]);
    }
    scale /= length;
  }
  row[2 * points] = byOwn;
  return row;
}

void SpanSystem::add(const LocalRow& row, double weight, double residual) {
  const auto count = static_cast<std::size_t>(localCount());
  for (std::size_t c = 0; c < count; ++c) {
    const double factor = weight * row[c];
    LocalRow& column = local_[c];
    for (std::size_t r = c; r < count; ++r) column[r] += factor * row[r];
    localGradient_[c] += residual * row[c];
  }
}

void SpanSystem::carry(const LocalRow& from, double* to) const {
  const std::size_t points = static_cast<std::size_t>(degree) + 1;
  for (std::size_t j = 0; j < points; ++j) {
    double x = 0.0, y = 0.0;
    for (std::size_t k = 0; k < points; ++k) {
      const double part = matrix[k][static_cast<Eigen::Index>(j)];
      x += part * from[2 * k];
      y += part * from[2 * k + 1];
    }
    to[2 * j] = x;
    to[2 * j + 1] = y;
  }
  for (int i = 0; i < lengthCount; ++i) {
    const auto& moved = byLength[i];
    double sum = i == ownLength ? from[2 * points] : 0.0;
    for (std::size_t k = 0; k < points; ++k) sum += moved[k].x() * from[2 * k] + moved[k].y() * from[2 * k + 1];
    to[2 * points + static_cast<std::size_t>(i)] = sum;
  }
}

void SpanSystem::finish() {
  const auto count = static_cast<std::size_t>(localCount());
  if (lengthCount == 0) {  // a single span: its Bezier points are the control points
    for (std::size_t c = 0; c < count; ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      for (std::size_t r = c; r < count; ++r) squares(static_cast<Eigen::Index>(r), column) = local_[c][r];
      gradient[column] = localGradient_[c];
    }
    return;
  }
  for (std::size_t c = 0; c < count; ++c) {
    for (std::size_t r = c + 1; r < count; ++r) local_[r][c] = local_[c][r];
  }
  // Half way: rows are local, columns already the unknowns.
  std::array<LocalRow, static_cast<std::size_t>(kMost)> half;
  std::array<double, static_cast<std::size_t>(kMost)> column{};
  for (std::size_t r = 0; r < count; ++r) {
    carry(local_[r], column.data());
    for (int c = 0; c < used; ++c) half[c][r] = column[c];
  }
  for (int c = 0; c < used; ++c) {
    carry(half[c], column.data());
    for (int r = c; r < used; ++r) squares(r, c) = column[r];
  }
  carry(localGradient_, gradient.data());
}

}  // namespace batten
