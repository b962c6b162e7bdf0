// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "core/construct/light/light_rows.h"
#include "core/construct/light/span_basis.h"

namespace batten {

/// A span of a quintic with simple knots depends on its own length and on so many to either side.
inline constexpr int kLengthReach = 4;
inline constexpr int kLengthsOfSpan = 2 * kLengthReach + 1;

/// The normal equations of one span: rows are gathered by the span's Bezier points and its own length, and only their
/// sum is carried over to what these depend on, the control points and the lengths of the spans around.
struct SpanSystem {
  static constexpr int kLocal = 2 * static_cast<int>(kSpanPoints) + 1;  ///< x and y of the Bezier points; own length.
  static constexpr int kMost = 2 * static_cast<int>(kSpanPoints) + kLengthsOfSpan;
  using LocalRow = std::array<double, static_cast<std::size_t>(kLocal)>;
  using PointRow = Eigen::Array<double, static_cast<int>(kSpanPoints), 1>;
  std::array<PointRow, kSpanPoints> matrix;                            ///< Bezier points by control points.
  std::array<std::array<Vec2, kSpanPoints>, kLengthsOfSpan> byLength;  ///< Bezier points by the logarithms of lengths.
  std::array<int, kLengthsOfSpan> lengthIndex{};                       ///< Which spans' lengths those are,
  int lengthCount = 0;
  std::optional<int> ownLength;  ///< and which of them is the span's own.
  double length = 1.0;
  int degree = 5;
  double share = 1.0;                           ///< Of a row in the mean of all places.
  Eigen::Matrix<double, kMost, kMost> squares;  ///< Lower triangle; by x and y of the control points, then by lengths.
  Eigen::Matrix<double, kMost, 1> gradient;
  int used = 0;

  /// Before the first row: all else is set.
  void begin();
  /// Row of a residual with these gradients by the position and its derivatives at a place of the span.
  LocalRow rowOf(const PlaceTable::Place&, const PlaceState&, const DerivativeGradients&) const;
  /// Adds a row with its weight (squared) and weighted residual.
  void add(const LocalRow&, double weight, double residual);
  /// After the last row: fills `squares` and `gradient`.
  void finish();

 private:
  int localCount() const { return 2 * (degree + 1) + (lengthCount > 0 ? 1 : 0); }
  /// A column by Bezier points and own length becomes one by what they depend on.
  void carry(const LocalRow& from, double* to) const;

  std::array<LocalRow, static_cast<std::size_t>(kLocal)> local_;  ///< Column by column, the lower triangle.
  LocalRow localGradient_;
};

}  // namespace batten
