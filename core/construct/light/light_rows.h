// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/base/vec2.h"

namespace batten {

/// Gradients with respect to the first three derivatives of the curve by its parameter (index = order; 0 stays zero).
using DerivativeGradients = std::array<Vec2, 4>;

/// Position and derivatives of a curve at a place, and what follows from them.
struct PlaceState {
  std::array<Vec2, 4> d;  ///< C, C', C'', C'''.
  double speed = 0.0;     ///< |C'|
  double kappa = 0.0;     ///< Curvature.
  double slope = 0.0;     ///< d kappa / ds = (Y v^2 - 3 X d) / v^6, X = C' x C'', Y = C' x C''', d = C'.C''.
};
/// @pre the derivatives are filled. Where C' vanishes the rest is not finite.
void completePlace(PlaceState&);

/// Of the curvature.
DerivativeGradients kappaGradient(const PlaceState&);
/// Of the curvature's slope.
DerivativeGradients slopeGradient(const PlaceState&);
/// Of the speed.
DerivativeGradients speedGradient(const PlaceState&);
/// Of the component of the unit tangent along a direction.
DerivativeGradients tangentGradient(const PlaceState&, const Vec2& direction);

}  // namespace batten
