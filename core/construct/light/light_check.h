// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/construct/light/light_reference.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// What a light curve must hold, looked at densely: at least 400 places, and every curvature extremum wherever it lies.
struct LightBounds {
  double tolerance = 0.0;  ///< [unit of the curve] Farthest that it lies from the dense one.
  int extrema = 0;         ///< At the most, of prominence kExtremumProminence / extent.
  int inflections = 0;     ///< At the most.
};
struct LightVerdict {
  bool holds = false;
  double worst = 0.0;                ///< Largest distance of the two curves.
  int extrema = 0, inflections = 0;  ///< Counted only when the distance holds.
};
/// Distance both ways (the feet must run over all of the reference in order), extrema and inflections, and that the
/// speed nowhere falls below a tenth of its mean.
LightVerdict checkLight(const NurbsCurve&, const LightReference&, const LightBounds&);

/// At how many places of each of a curve's spans a light curve is looked at: 40, and 400 along the whole curve.
int checkedPlacesPerSpan(int spans);

/// Prominence with which the extrema of both curves are counted.
double lightProminence(const LightReference&);

}  // namespace batten
