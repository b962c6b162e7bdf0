// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/curve/uniform_quintic.h"
#include "tests/support/truth_shapes.h"

namespace batten::test {

/// A dense quintic spline through the points of a known piece, knots every 6 px: the truth to far below a hundredth of
/// a pixel.
inline NurbsCurve denseCurve(const TruthPiece& piece, bool closed) {
  std::vector<double> t(1, 0.0);
  for (std::size_t i = 1; i < piece.points.size(); ++i) {
    t.push_back(t.back() + (piece.points[i] - piece.points[i - 1]).norm());
  }
  const double length = t.back() + (closed ? (piece.points.front() - piece.points.back()).norm() : 0.0);
  std::vector<double> weights(t.size(), 1.0);
  if (!closed) weights.front() = weights.back() = 1e6;
  const UniformKnots knots{length, std::max(6, static_cast<int>(std::lround(length / 6.0))), closed};
  const auto fitted = fitUniformQuintic(knots, t, piece.points, weights, 1e-9);
  if (!fitted) throw std::runtime_error("no dense curve");
  const auto curve = fitted->toNurbs();
  if (!curve) throw std::runtime_error("no dense curve");
  return *curve;
}

}  // namespace batten::test
