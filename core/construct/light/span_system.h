// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/construct/light/bezier_spans.h"
#include "core/construct/light/light_rows.h"
#include "core/construct/light/span_kernels.h"

namespace batten {

/// A span of a quintic with simple knots depends on its own length and on so many to either side.
inline constexpr int kLengthReach = 4;
inline constexpr int kLengthsOfSpan = 2 * kLengthReach + 1;  // its own among them

/// The normal equations of one span: rows are gathered by the span's Bezier points and its own length, and only their
/// sum is carried over to what these depend on, the control points and the lengths of the spans around. Keeps its
/// memory from span to span.
class SpanSystem {
 public:
  /// Unknowns of a span.
  static constexpr int kMost = 2 * static_cast<int>(kSpanPoints) + kLengthsOfSpan;

  SpanDependence dependence;                      ///< Not read without lengths.
  std::array<int, kLengthsOfSpan> lengthIndex{};  ///< Which spans' lengths those are,
  int lengthCount = 0;                            ///< 0: a single span, whose Bezier points are its control points,
  int ownLength = 0;                              ///< and which of them is the span's own.
  double length = 1.0;                            ///< Of the span.
  int degree = 5;
  double share = 1.0;  ///< Of a row in the mean of all places.

  /// Before the first row: all else is set.
  void begin() { rows_.clear(); }
  /// Adds the row of a residual with these gradients by the position and its derivatives at a place of the span, with
  /// its weight (squared) and weighted residual.
  void add(const PlaceTable::Place&, const PlaceState&, const DerivativeGradients&, double weight, double residual);
  /// After the last row.
  void sumAndCarry();

  /// Unknowns: x and y of every control point in turn, then lengths.
  int used() const { return 2 * (degree + 1) + lengthCount; }
  /// Where an unknown stands in the rows and columns of `squares` and in `gradient`.
  int lane(int unknown) const {
    const int points = degree + 1;
    if (unknown >= 2 * points) return 2 * kXLanes + unknown - 2 * points;
    return unknown / 2 + (unknown % 2) * kXLanes;
  }
  /// Only what belongs to a row that does not come before its column.
  const std::array<UnknownRow, kUnknownLanes>& squares() const { return squares_; }
  const UnknownRow& gradient() const { return gradient_; }

 private:
  void carryGradient();

  std::vector<WeighedRow> rows_;
  LocalSquares local_;
  std::array<UnknownRow, kUnknownLanes> squares_;
  UnknownRow gradient_;
};

}  // namespace batten
