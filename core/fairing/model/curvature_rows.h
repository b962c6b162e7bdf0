// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/base/vec2.h"
#include "core/curve/span_curve.h"

namespace batten {

/// d kappa / d q at a fixed parameter, per control point of the span (003 section 4; algorithms: shape modification):
/// row[j] = (d kappa / d x_j, d kappa / d y_j) with s = |R'|.
using LocalRow = std::array<Vec2, kMaxDegree + 1>;
/// d kappa / d R' and d kappa / d R'': by them a control point counts with the derivatives of its basis function.
struct CurvatureWeights {
  Vec2 first, second;
};
CurvatureWeights curvatureWeights(const Jet& jet);
LocalRow curvatureRow(const Jet& jet, const SpanRow& basis, int degree);
/// The same for d kappa / d s, the change of curvature along the curve.
LocalRow curvatureSlopeRow(const Jet& jet, const SpanRow& basis, int degree);

/// Signed curvature of a jet and its first and second derivatives with respect to arc length. @pre |R'| > 0.
struct CurvatureJet {
  double kappa = 0.0, slope = 0.0, bend = 0.0;  ///< [1/mm, 1/mm^2, 1/mm^3]
  double speed = 0.0;                           ///< [mm] |R'|, per unit of the parameter.
};
CurvatureJet curvatureJet(const Jet& jet);

}  // namespace batten
