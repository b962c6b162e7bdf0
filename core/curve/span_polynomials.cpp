// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/span_polynomials.h"

namespace batten {

SpanPolynomials::SpanPolynomials(const NurbsCurve& curve) : curve_(curve) {
  if (curve.isRational()) return;
  basis_ = std::make_shared<const SpanBasis>(curve.degree(), curve.knots(), curve.controlPointCount(), 0);
  spans_ = SpanCurve(*basis_, curve.controlPoints());
}

std::array<Vec2, 3> SpanPolynomials::at(double u) const {
  if (!basis_) {
    const auto d = curve_.derivatives(u, 2);
    return {d[0], d[1], d[2]};
  }
  const Jet jet = spans_.at(basis_->place(u), 2);
  return {jet[0], jet[1], jet[2]};
}

}  // namespace batten
