// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/span_polynomials.h"

namespace batten {

SpanPolynomials::SpanPolynomials(const NurbsCurve& curve) : curve_(curve) {
  if (curve.isRational()) return;
  basis_ = std::make_shared<const SpanBasis>(curve.degree(), curve.knots(), curve.controlPointCount(), 0);
  spans_ = SpanCurve(*basis_, curve.controlPoints());
}

std::array<Vec2, 3> SpanPolynomials::at(double u) const {
  const Jet jet = derivatives(u, 2);
  return {jet[0], jet[1], jet[2]};
}

Jet SpanPolynomials::derivatives(double u, int order) const {
  return basis_ ? spans_.at(basis_->place(u), order) : curve_.derivatives(u, order);
}

}  // namespace batten
