// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// The polynomials of a curve's spans, for whoever evaluates one curve many times: several times as fast as its
/// B-spline basis, equal to it up to rounding. A rational curve has none; it is evaluated as it is.
class SpanPolynomials {
 public:
  explicit SpanPolynomials(const NurbsCurve&);
  /// Point, first and second derivative at u, clamped to the domain. At a knot: of the span that begins there.
  std::array<Vec2, 3> at(double u) const;
  double start() const { return curve_.start(); }
  double end() const { return curve_.end(); }

 private:
  NurbsCurve curve_;
  int degree_ = 0;
  std::vector<double> breaks_;      ///< Of the spans; empty for a rational curve.
  std::vector<Vec2> coefficients_;  ///< Degree + 1 of each span, of the powers of its local parameter 0..1.
};

}  // namespace batten
