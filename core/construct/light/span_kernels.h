// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/base/vec2.h"
#include "core/construct/light/bezier_spans.h"

/// The loops that a light fit spends its time in, on plain arrays of known widths; every element is computed by itself,
/// so that wider vectors give the same bits.
namespace batten {

/// Numbers of a row by the Bezier points of a span, x and y in turn, and after those of six or fewer by the span's own
/// length; the rest is not used.
inline constexpr int kRowWidth = 2 * static_cast<int>(kSpanPoints);
/// Lengths of spans that a span depends on, filled up.
inline constexpr int kLengthLanes = 12;
/// Unknowns of a span: x of the control points, then y, then lengths.
inline constexpr int kXLanes = static_cast<int>(kSpanPoints);
inline constexpr int kUnknownLanes = 2 * kXLanes + kLengthLanes;  // all of them

/// Position and three derivatives of `points` Bezier points at a place of which these are the columns, x and y in turn:
/// summed point by point.
using PlaceSums = std::array<double, 8>;
PlaceSums sumPoints(const std::array<PlaceSums, kSpanPoints>& columns, const std::array<Vec2, kSpanPoints>& bezier,
                    int points);

/// A row of a system with its weight (squared) and its weighted residual.
struct WeighedRow {
  std::array<double, kRowWidth> row;
  double weight, residual;  ///< [-] `residual` is multiplied by the weight already.
};
/// squares[c][r] = sum of weight row[c] row[r] and gradient[r] = sum of residual row[r], over all rows in their order;
/// c < columns, all r.
struct LocalSquares {
  std::array<std::array<double, kRowWidth>, kRowWidth> squares;
  std::array<double, kRowWidth> gradient;
};
/// `sums` is the memory of a span: what it held is lost.
void sumRows(const WeighedRow* rows, int count, int columns, LocalSquares& sums);

/// How the Bezier points of a span depend on its control points and on lengths.
struct SpanDependence {
  std::array<std::array<double, kXLanes>, kSpanPoints> byPoint;  ///< Bezier points by control points.
  /// Their coordinates by lengths of spans.
  std::array<std::array<double, kLengthLanes>, kSpanPoints> xByLength, yByLength;
};
using UnknownRow = std::array<double, kUnknownLanes>;
/// What the squares of rows by `points` Bezier points and the own length (`ownLength` of `lengths`) come to by the
/// unknowns. @param local symmetric. @param squares one row for every unknown in use; the columns of x and y in all
/// rows, those of lengths only in the rows of lengths.
void carrySquares(const LocalSquares& local, const SpanDependence&, int points, int lengths, int ownLength,
                  std::array<UnknownRow, kUnknownLanes>& squares);

/// bezierOfSpan for as many sets of knots as there are lanes: knots[k][lane].
using KnotLanes = std::array<std::array<double, kLengthLanes>, 2 * kMostLightDegree>;
using PointLanes = std::array<std::array<double, kLengthLanes>, kSpanPoints>;
/// @param x,y the memory that keeps them, of which degree + 1 rows are written.
void bezierOfLanes(int degree, const KnotLanes& knots, const std::array<Vec2, kSpanPoints>& points, PointLanes& x,
                   PointLanes& y);

}  // namespace batten
