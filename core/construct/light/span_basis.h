// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

inline constexpr int kMostLightDegree = 7;
/// Control points that a span of a curve depends on.
inline constexpr std::size_t kSpanPoints = kMostLightDegree + 1;

/// Bernstein polynomials of one degree and their first three derivatives at fixed places of a span.
struct PlaceTable {
  /// rows[order][k]: k-th Bernstein polynomial, differentiated `order` times by the span's own parameter 0..1.
  struct Place {
    double at = 0.0;
    std::array<std::array<double, kSpanPoints>, 4> rows{};
  };
  std::vector<Place> places;
};
PlaceTable::Place bernsteinPlace(int degree, double at);
/// `count` places at equal steps, both ends of the span included. @pre count >= 2.
PlaceTable placeTable(int degree, int count);

/// Knots that the span [knots[degree - 1], knots[degree]] depends on: 2 degree of them.
using SpanKnots = std::array<double, 2 * kMostLightDegree>;

/// Bezier points of a span of a B-spline from the degree + 1 control points that it depends on, by blossoming: point k
/// is the blossom with the span's start degree - k times and its end k times. `Value`: Vec2, or rows of a matrix.
template <class Value>
void bezierOfSpan(int degree, const SpanKnots& knots, const std::array<Value, kSpanPoints>& points,
                  std::array<Value, kSpanPoints>& bezier) {
  const auto p = static_cast<std::size_t>(degree);
  const auto step = [&](std::size_t level, double x, const Value* from, Value* to) {
    for (std::size_t i = 0; i + level <= p; ++i) {
      const double low = knots[i + level - 1], high = knots[i + p];
      const double share = (x - low) / (high - low);
      to[i] = (1.0 - share) * from[i] + share * from[i + 1];
    }
  };
  // Row m: after m insertions of the start. The Bezier point k goes on from row degree - k with k of the end.
  std::array<Value, kSpanPoints> atStart = points;
  for (std::size_t m = 0;; ++m) {
    std::array<Value, kSpanPoints> work = atStart;
    for (std::size_t level = m + 1; level <= p; ++level) step(level, knots[p], work.data(), work.data());
    bezier[p - m] = work[0];
    if (m == p) break;
    step(m + 1, knots[p - 1], atStart.data(), atStart.data());
  }
}

}  // namespace batten
