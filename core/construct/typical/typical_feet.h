// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/construct/typical/typical_curve.h"

namespace batten {

/// How far a point lies from a curve, to its left, and the parameter of its foot.
struct CurveFoot {
  double distance = 0.0, t = 0.0;
};

/// Feet of points in order, each searched from the one before. The curve is 0..1; the feet of points beside its ends
/// lie a little beyond.
std::vector<CurveFoot> feetOn(const TypicalCurve& c, std::span<const Vec2> points);

}  // namespace batten
