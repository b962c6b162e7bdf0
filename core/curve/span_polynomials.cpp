// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/span_polynomials.h"

#include <algorithm>

#include "core/curve/knot_operations.h"

namespace batten {

SpanPolynomials::SpanPolynomials(const NurbsCurve& curve) : curve_(curve), degree_(curve.degree()) {
  const auto pieces = bezierPieces(curve);
  if (!pieces || pieces->empty()) return;
  for (const BezierPiece& piece : *pieces) {
    breaks_.push_back(piece.start);
    // The k-th coefficient is the k-th forward difference of the control points times the binomial coefficient.
    std::vector<Vec2> differences = piece.controlPoints;
    double binomial = 1.0;
    for (int k = 0; k <= degree_; ++k) {
      coefficients_.push_back(binomial * differences.front());
      for (std::size_t j = 0; j + 1 < differences.size(); ++j) differences[j] = differences[j + 1] - differences[j];
      differences.pop_back();
      binomial *= static_cast<double>(degree_ - k) / (k + 1);
    }
  }
  breaks_.push_back(pieces->back().end);
}

std::array<Vec2, 3> SpanPolynomials::at(double u) const {
  if (breaks_.empty()) {
    const auto d = curve_.derivatives(u, 2);
    return {d[0], d[1], d[2]};
  }
  const double x = std::clamp(u, breaks_.front(), breaks_.back());
  const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, x);
  const auto span = static_cast<std::size_t>(above - breaks_.begin()) - 1;
  const double width = breaks_[span + 1] - breaks_[span], t = (x - breaks_[span]) / width;
  const Vec2* c = &coefficients_[span * static_cast<std::size_t>(degree_ + 1)];
  Vec2 point = c[degree_], first = Vec2::Zero(), half = Vec2::Zero();
  for (int k = degree_ - 1; k >= 0; --k) {
    half = half * t + first;
    first = first * t + point;
    point = point * t + c[k];
  }
  return {point, first / width, 2.0 * half / (width * width)};
}

}  // namespace batten
