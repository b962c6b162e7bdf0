// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/span_kernels.h"

#include "core/base/hot_loop.h"

namespace batten {
namespace {

/// += for two columns at a time: their sums stay in registers over all rows.
BATTEN_HOT_LOOP void sumColumns(const WeighedRow* __restrict rows, int count, int columns, double* __restrict squares) {
  for (int c = 0; c < columns; c += 2) {
    double first[kRowWidth] = {}, second[kRowWidth] = {};
    for (int i = 0; i < count; ++i) {
      const double* row = rows[i].row.data();
      const double a = rows[i].weight * row[c], b = rows[i].weight * row[c + 1];
      for (int r = 0; r < kRowWidth; ++r) first[r] += a * row[r];
      for (int r = 0; r < kRowWidth; ++r) second[r] += b * row[r];
    }
    for (int r = 0; r < kRowWidth; ++r) squares[c * kRowWidth + r] = first[r];
    for (int r = 0; r < kRowWidth; ++r) squares[(c + 1) * kRowWidth + r] = second[r];
  }
}

BATTEN_HOT_LOOP void addPoints(const double* columns, const double* bezier, int points, double* __restrict out) {
  double low[4] = {}, high[4] = {};
  for (int k = 0; k < points; ++k, columns += 8, bezier += 2) {
    const double xy[4] = {bezier[0], bezier[1], bezier[0], bezier[1]};
    for (int i = 0; i < 4; ++i) low[i] += columns[i] * xy[i];
    for (int i = 0; i < 4; ++i) high[i] += columns[4 + i] * xy[i];
  }
  for (int i = 0; i < 4; ++i) out[i] = low[i];
  for (int i = 0; i < 4; ++i) out[4 + i] = high[i];
}

BATTEN_HOT_LOOP void sumResiduals(const WeighedRow* __restrict rows, int count, double* __restrict gradient) {
  double sums[kRowWidth] = {};
  for (int i = 0; i < count; ++i) {
    for (int r = 0; r < kRowWidth; ++r) sums[r] += rows[i].residual * rows[i].row[r];
  }
  for (int r = 0; r < kRowWidth; ++r) gradient[r] = sums[r];
}

/// Rows by the unknowns: one local column (or row) after the other.
BATTEN_HOT_LOOP void carryRows(const double* __restrict local, const SpanDependence& by, int points, int ownLength,
                               double* __restrict half) {
  const int count = 2 * points + 1;
  for (int l = 0; l < count; ++l) {
    const double* from = local + l * kRowWidth;
    double x[kXLanes] = {}, y[kXLanes] = {}, lengths[kLengthLanes] = {};
    lengths[ownLength] = from[2 * points];
    for (int k = 0; k < points; ++k) {
      const double *part = by.byPoint[k].data(), *moveX = by.xByLength[k].data(), *moveY = by.yByLength[k].data();
      const double fromX = from[2 * k], fromY = from[2 * k + 1];
      for (int j = 0; j < kXLanes; ++j) x[j] += part[j] * fromX;
      for (int j = 0; j < kXLanes; ++j) y[j] += part[j] * fromY;
      for (int i = 0; i < kLengthLanes; ++i) lengths[i] += moveX[i] * fromX + moveY[i] * fromY;
    }
    double* to = half + l * kUnknownLanes;
    for (int j = 0; j < kXLanes; ++j) to[j] = x[j];
    for (int j = 0; j < kXLanes; ++j) to[kXLanes + j] = y[j];
    for (int i = 0; i < kLengthLanes; ++i) to[2 * kXLanes + i] = lengths[i];
  }
}

/// The rows of one control point, by the columns of points.
BATTEN_HOT_LOOP void carryPoints(const double* __restrict half, const SpanDependence& by, int points,
                                 double* __restrict squares) {
  constexpr int kPointLanes = 2 * kXLanes;  // x and y
  for (int j = 0; j < points; ++j) {
    double x[kPointLanes] = {}, y[kPointLanes] = {};
    for (int k = 0; k < points; ++k) {
      const double part = by.byPoint[k][j];
      const double *fromX = half + 2 * k * kUnknownLanes, *fromY = fromX + kUnknownLanes;
      for (int c = 0; c < kPointLanes; ++c) x[c] += part * fromX[c];
      for (int c = 0; c < kPointLanes; ++c) y[c] += part * fromY[c];
    }
    for (int c = 0; c < kPointLanes; ++c) squares[j * kUnknownLanes + c] = x[c];
    for (int c = 0; c < kPointLanes; ++c) squares[(kXLanes + j) * kUnknownLanes + c] = y[c];
  }
}

/// The rows of the lengths.
BATTEN_HOT_LOOP void carryLengths(const double* __restrict half, const SpanDependence& by, int points, int lengths,
                                  int ownLength, double* __restrict squares) {
  for (int i = 0; i < lengths; ++i) {
    double sums[kUnknownLanes] = {};
    if (i == ownLength) {
      for (int c = 0; c < kUnknownLanes; ++c) sums[c] = half[2 * points * kUnknownLanes + c];
    }
    for (int k = 0; k < points; ++k) {
      const double moveX = by.xByLength[k][i], moveY = by.yByLength[k][i];
      const double *fromX = half + 2 * k * kUnknownLanes, *fromY = fromX + kUnknownLanes;
      for (int c = 0; c < kUnknownLanes; ++c) sums[c] += moveX * fromX[c] + moveY * fromY[c];
    }
    for (int c = 0; c < kUnknownLanes; ++c) squares[(2 * kXLanes + i) * kUnknownLanes + c] = sums[c];
  }
}

constexpr int kMostShares = kMostLightDegree * (kMostLightDegree + 1) / 2;  // one for each mix of two points

/// Shares of bezierOfSpan, level by level, for one place of the span.
BATTEN_HOT_LOOP void sharesOfLanes(int degree, const double* __restrict knots, const double* __restrict place,
                                   double* __restrict shares) {
  for (int level = 1; level <= degree; ++level) {
    for (int i = 0; i + level <= degree; ++i, shares += kLengthLanes) {
      const double *low = knots + (i + level - 1) * kLengthLanes, *high = knots + (i + degree) * kLengthLanes;
      for (int n = 0; n < kLengthLanes; ++n) shares[n] = (place[n] - low[n]) / (high[n] - low[n]);
    }
  }
}

/// One coordinate of the control points (in `row`, which is lost) to that of the Bezier points.
BATTEN_HOT_LOOP void mixLanes(int degree, const double* __restrict atStart, const double* __restrict atEnd,
                              double* __restrict row, double* __restrict bezier) {
  const auto mix = [](const double* shares, int count, double* values) {
    for (int i = 0; i < count; ++i, shares += kLengthLanes, values += kLengthLanes) {
      for (int n = 0; n < kLengthLanes; ++n) {
        values[n] = (1.0 - shares[n]) * values[n] + shares[n] * values[kLengthLanes + n];
      }
    }
  };
  double work[kSpanPoints * kLengthLanes];
  for (int m = 0;; ++m) {
    for (int i = 0; i < (degree + 1) * kLengthLanes; ++i) work[i] = row[i];
    const double* shares = atEnd;
    for (int level = 1; level <= degree; ++level) {
      const int count = degree - level + 1;
      if (level > m) mix(shares, count, work);
      shares += count * kLengthLanes;
    }
    for (int n = 0; n < kLengthLanes; ++n) bezier[(degree - m) * kLengthLanes + n] = work[n];
    if (m == degree) return;
    mix(atStart, degree - m, row);
    atStart += (degree - m) * kLengthLanes;
  }
}

}  // namespace

PlaceSums sumPoints(const std::array<PlaceSums, kSpanPoints>& columns, const std::array<Vec2, kSpanPoints>& bezier,
                    int points) {
  PlaceSums sums;
  addPoints(columns.front().data(), bezier.front().data(), points, sums.data());
  return sums;
}

void sumRows(const WeighedRow* rows, int count, int columns, LocalSquares& sums) {
  sumColumns(rows, count, columns, sums.squares.front().data());
  sumResiduals(rows, count, sums.gradient.data());
}

void carrySquares(const LocalSquares& local, const SpanDependence& by, int points, int lengths, int ownLength,
                  std::array<UnknownRow, kUnknownLanes>& squares) {
  std::array<UnknownRow, kRowWidth> half;
  carryRows(local.squares.front().data(), by, points, ownLength, half.front().data());
  carryPoints(half.front().data(), by, points, squares.front().data());
  carryLengths(half.front().data(), by, points, lengths, ownLength, squares.front().data());
}

void bezierOfLanes(int degree, const KnotLanes& knots, const std::array<Vec2, kSpanPoints>& points, PointLanes& x,
                   PointLanes& y) {
  std::array<double, kMostShares * kLengthLanes> atStart, atEnd;
  sharesOfLanes(degree, knots.front().data(), knots[degree - 1].data(), atStart.data());
  sharesOfLanes(degree, knots.front().data(), knots[degree].data(), atEnd.data());
  PointLanes rowX, rowY;
  for (int j = 0; j <= degree; ++j) {
    rowX[j].fill(points[j].x());
    rowY[j].fill(points[j].y());
  }
  mixLanes(degree, atStart.data(), atEnd.data(), rowX.front().data(), x.front().data());
  mixLanes(degree, atStart.data(), atEnd.data(), rowY.front().data(), y.front().data());
}

}  // namespace batten
