// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Where a rounding meets the side of a corner.
struct BlendEnd {
  Vec2 point = Vec2::Zero();     ///< [mm]
  Vec2 tangent = Vec2::UnitX();  ///< Unit, in the direction of travel.
  double kappa = 0.0;            ///< [1/mm]
  double kappaSlope = 0.0;       ///< [1/mm^2] d kappa / d s.
};
/// The end of a blend at a parameter of a curve. @pre the curve has a direction there.
BlendEnd blendEndAt(const NurbsCurve&, double u);

/// How smoothly a blend meets its sides.
enum class BlendContact { G2, G3 };

/// A rounding of a corner as one Bezier piece: of degree 5 with the sides' place, direction and curvature (G2), of
/// degree 7 with the change of curvature, too (G3). Its free lengths are chosen such that the curvature rises to one
/// peak and falls again, and the peak is low.
struct CornerBlend {
  NurbsCurve curve;               ///< Over 0..1.
  double smallestRadiusMm = 0.0;  ///< [mm] At the peak of the curvature.
};
/// @return absent where the directions do not meet ahead of the first and behind the second place, or the turn is below
/// 0.01 or above 3.0 radians.
std::optional<CornerBlend> blendCorner(const BlendEnd& before, const BlendEnd& behind, BlendContact contact);

/// Smallest radius of curvature of a curve, at 200 places.
double smallestRadius(const NurbsCurve&);

}  // namespace batten
