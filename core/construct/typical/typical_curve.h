// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/curve/bezier_quintics.h"

namespace batten {

/// A typical curve (002): the cubic whose control polygon has edges l, h l, h^2 l, each turned by phi against the one
/// before.
struct TypicalCurve {
  Vec2 start = Vec2::Zero();  ///< [mm]
  double angleRad = 0.0;      ///< Direction of the first edge.
  double edge = 0.0;          ///< l [mm] > 0
  double ratio = 1.0;         ///< h > 0
  double turnRad = 0.0;       ///< phi, positive to the left, |phi| < pi / 2.

  std::array<Vec2, 4> controlPoints() const;
  double size() const;            ///< dS = l (1 + h cos(phi) + h^2) [mm]
  double startCurvature() const;  ///< 2 h sin(phi) / (3 l) [1/mm]
  double endCurvature() const;    ///< startCurvature / h^4
  Joint startJoint() const;
  Joint endJoint() const;
  /// The curvature has no extremum inside: h <= cos(phi) or h >= 1 / cos(phi).
  bool isMonotone() const;
  /// The same curve over the parameters 0..e: e > 1 extrapolates, e < 1 truncates. Exact: z = 1 + e (h e^(i phi) - 1).
  TypicalCurve toParameter(double e) const;
};

/// From the form (002 section 3): curvature at the start, size and change of direction. h is the one real root of
/// h^3 + cos(phi) h^2 + h = 3 dS kappa0 / (2 sin(phi)), phi = dW / 2. Absent where there is none: kappa0 = 0, no turn,
/// opposite signs, or a turn of pi and more.
std::optional<TypicalCurve> typicalFromForm(const Vec2& start, double angleRad, double startCurvature, double size,
                                            double changeOfAngleRad);
/// From the curvatures of both ends and the change of direction: h = (kappa0 / kappa1)^(1/4), l = 2 h sin(phi) / (3
/// kappa0). Absent as above.
std::optional<TypicalCurve> typicalFromCurvatures(const Vec2& start, double angleRad, double startCurvature,
                                                  double endCurvature, double changeOfAngleRad);

/// How a typical curve changes with phi while place, direction and curvature at its start and its size dS stay
/// (002 Eq 7, 8).
struct FormGradient {
  double edgeByTurn = 0.0;        ///< dl / dphi
  double ratioByTurn = 0.0;       ///< dh / dphi
  Vec2 endByTurn = Vec2::Zero();  ///< dC(1) / dphi, in the frame of the curve itself.
};
FormGradient formGradient(const TypicalCurve&);

}  // namespace batten
