// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "core/construct/light/light_rows.h"
#include "core/construct/light/span_basis.h"

namespace batten {

/// A span of a quintic with simple knots depends on its own length and on so many to either side.
inline constexpr int kLengthReach = 4;
inline constexpr int kLengthsOfSpan = 2 * kLengthReach + 1;

/// Derivatives of one span's places by what the span depends on.
struct SpanSystem {
  static constexpr Eigen::Index kMost = 2 * static_cast<Eigen::Index>(kSpanPoints) + kLengthsOfSpan;
  using Row = Eigen::Matrix<double, kMost, 1>;
  using PointRow = Eigen::Array<double, static_cast<int>(kSpanPoints), 1>;
  std::array<PointRow, kSpanPoints> matrix;                            ///< Bezier points by control points.
  std::array<std::array<Vec2, kSpanPoints>, kLengthsOfSpan> byLength;  ///< Bezier points by the logarithms of lengths.
  std::array<int, kLengthsOfSpan> lengthIndex{};                       ///< Which spans' lengths those are,
  int lengthCount = 0;
  std::optional<int> ownLength;  ///< and which of them is the span's own.
  double length = 1.0;
  int degree = 5;
  double share = 1.0;  ///< Of a row in the mean of all places.
  Eigen::Matrix<double, kMost, kMost> squares;
  Row gradient;
  Eigen::Index used = 0;

  /// Before the first row: all else is set.
  void begin() {
    used = 2 * (degree + 1) + lengthCount;
    squares.topLeftCorner(used, used).setZero();
    gradient.setZero();
  }
  /// Rows of C .. C''' by all unknowns at a place of the span.
  struct Derivatives {
    std::array<PointRow, 4> byPoint;
    std::array<std::array<Vec2, kLengthsOfSpan>, 4> byLogLength;
  };
  Derivatives at(const PlaceTable::Place& place, const PlaceState& state) const {
    Derivatives result;
    double scale = 1.0;
    for (std::size_t order = 0; order < 4; ++order) {
      PointRow row = PointRow::Zero();
      for (int k = 0; k <= degree; ++k) row += place.rows[order][k] * matrix[k];
      result.byPoint[order] = scale * row;
      for (int i = 0; i < lengthCount; ++i) {
        Vec2 sum = Vec2::Zero();
        for (int k = 0; k <= degree; ++k) {
          sum += place.rows[order][k] * byLength[i][k];
        }
        sum *= scale;
        if (i == ownLength) sum -= static_cast<double>(order) * state.d[order];
        result.byLogLength[order][i] = sum;
      }
      scale /= length;
    }
    return result;
  }
  Row rowOf(const Derivatives& d, const DerivativeGradients& gradients) const {
    Row row = Row::Zero();
    for (std::size_t order = 0; order < 4; ++order) {
      const Vec2& g = gradients[order];
      if (g.x() == 0.0 && g.y() == 0.0) continue;
      for (Eigen::Index j = 0; j <= degree; ++j) {
        row[2 * j] += g.x() * d.byPoint[order][j];
        row[2 * j + 1] += g.y() * d.byPoint[order][j];
      }
      for (int i = 0; i < lengthCount; ++i) {
        row[2 * (degree + 1) + i] += g.dot(d.byLogLength[order][i]);
      }
    }
    return row;
  }
  /// Adds a row with its weight (squared) and weighted residual.
  void add(const Row& row, double weight, double residual) {
    for (Eigen::Index c = 0; c < used; ++c) {
      const double factor = weight * row[c];
      for (Eigen::Index r = 0; r < used; ++r) squares(r, c) += factor * row[r];
      gradient[c] += residual * row[c];
    }
  }
};

}  // namespace batten
