// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/construct/light/bezier_spans.h"
#include "core/construct/light/light_reference.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// A curve while it is being fitted: one span of degree 2..7, or a B-spline of degree 5 with simple knots (C4). Only
/// the ratios of the span lengths matter.
struct LightShape {
  int degree = 5;  ///< 2..7
  bool closed = false;
  std::vector<Vec2> points;        ///< Spans + degree of them; closed: as many as spans.
  std::vector<double> logLengths;  ///< One a span: logarithm of its share of the domain.

  int spans() const { return static_cast<int>(logLengths.size()); }
  /// Index of the j-th of the degree + 1 control points of a span.
  std::size_t pointOf(int span, int j) const {
    const std::size_t i = span + j;
    return closed ? i % points.size() : i;
  }
  /// Knots of a span, the span's start at 0. Lengths as exp(logLengths), or the ones given.
  SpanKnots knotsOf(int span, const std::vector<double>& lengths) const;
  /// The degree + 1 control points that a span depends on.
  std::array<Vec2, kSpanPoints> pointsOf(int span) const;
  /// [-] exp(logLengths).
  std::vector<double> lengths() const;

  /// As a clamped curve over the domain [0, length].
  std::optional<NurbsCurve> toNurbs(double length) const;
};

/// Where a spline's spans begin to look for their places.
enum class BreakStart {
  ByShape,  ///< Close where the curvature's second derivative is large.
  Even,     ///< Equal lengths.
};
/// Least squares through the reference at equal shares of length and domain; open: through both ends exactly.
std::optional<LightShape> startShape(const LightReference&, int degree, int spans, BreakStart);

}  // namespace batten
