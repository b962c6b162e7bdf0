// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/base/vec2.h"
#include "core/curve/bernstein.h"

namespace batten {

inline constexpr int kMostLightDegree = kMostBernsteinDegree;  // what bernsteinPolynomials() goes to
/// Control points that a span of a curve depends on.
inline constexpr std::size_t kSpanPoints = kMostLightDegree + 1;

/// Bernstein polynomials of one degree and their first three derivatives at fixed places of a span.
struct PlaceTable {
  /// rows[order][k]: k-th Bernstein polynomial, differentiated `order` times by the span's own parameter 0..1.
  struct Place {
    double at = 0.0;
    std::array<std::array<double, kSpanPoints>, 4> rows{};
    std::array<std::array<double, 2 * kSpanPoints>, 4> pairs{};  ///< Every number of the rows twice: for x and y.
    std::array<std::array<double, 8>, kSpanPoints> columns{};    ///< The same, by polynomial: those of all orders.
  };
  std::vector<Place> places;
};
/// Their values at one place, 0..1 of the span.
PlaceTable::Place bernsteinPlace(int degree, double at);
/// `count` places at equal steps, both ends of the span included. @pre count >= 2.
PlaceTable placeTable(int degree, int count);

/// Knots that the span [knots[degree - 1], knots[degree]] depends on: 2 degree of them.
using SpanKnots = std::array<double, 2 * kMostLightDegree>;

/// Bezier points of a span of a B-spline from the degree + 1 control points that it depends on, by blossoming: point k
/// is the blossom with the span's start degree - k times and its end k times. `Value`: Vec2, or rows of a matrix.
/// Written into the memory that a fit keeps for every span: what lies behind the degree stays as it is.
template <class Value>
void bezierOfSpan(int degree, const SpanKnots& knots, const std::array<Value, kSpanPoints>& points,
                  std::array<Value, kSpanPoints>& bezier) {
  // one for each mix of two points
  constexpr std::size_t kMostShares = kMostLightDegree * (kMostLightDegree + 1) / 2;
  const std::size_t p = degree;
  std::array<double, kMostShares> atStart, atEnd;  // level by level
  std::size_t at = 0;
  for (std::size_t level = 1; level <= p; ++level) {
    for (std::size_t i = 0; i + level <= p; ++i, ++at) {
      const double low = knots[i + level - 1], high = knots[i + p];
      atStart[at] = (knots[p - 1] - low) / (high - low);
      atEnd[at] = (knots[p] - low) / (high - low);
    }
  }
  const auto mix = [](const double* shares, std::size_t count, Value* values) {
    for (std::size_t i = 0; i < count; ++i) values[i] = (1.0 - shares[i]) * values[i] + shares[i] * values[i + 1];
  };
  // Row m: after m insertions of the start. The Bezier point k goes on from row degree - k with k of the end.
  std::array<Value, kSpanPoints> row = points;
  const double* start = atStart.data();
  for (std::size_t m = 0;; ++m) {
    std::array<Value, kSpanPoints> work = row;
    const double* end = atEnd.data();
    for (std::size_t level = 1; level <= p; ++level) {
      const std::size_t count = p - level + 1;
      if (level > m) mix(end, count, work.data());
      end += count;
    }
    bezier[p - m] = work[0];
    if (m == p) break;
    mix(start, p - m, row.data());
    start += p - m;
  }
}

}  // namespace batten
