// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>

#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"
#include "core/curve/span_curve.h"

namespace batten {

/// A curve by the polynomials of its spans, for whoever evaluates it many times: several times as fast as its B-spline
/// basis, equal to it up to rounding. A rational curve has none; it is evaluated as it is.
class SpanPolynomials {
 public:
  explicit SpanPolynomials(const NurbsCurve&);
  /// Point, first and second derivative at u, clamped to the domain. At a knot: of the span that begins there.
  std::array<Vec2, 3> at(double u) const;
  /// Derivatives up to `order` (0..4) there; those above are zero.
  Jet derivatives(double u, int order) const;
  double start() const { return curve_.start(); }
  double end() const { return curve_.end(); }

 private:
  NurbsCurve curve_;
  std::shared_ptr<const SpanBasis> basis_;  ///< Null for a rational curve. Shared: `spans_` points to it.
  SpanCurve spans_;
};

}  // namespace batten
