// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/vec2.h"
#include "core/construct/fair/fair_frame.h"
#include "core/curve/nurbs_curve.h"
#include "core/curve/uniform_quintic.h"

namespace batten {

/// Exact ends of a piece, where it has them; same frame as the points.
struct FairPins {
  std::optional<Vec2> start, end;
};

struct WeightedPoint {
  Vec2 at = Vec2::Zero();  ///< [px]
  double weight = 1.0;     ///< 1: a block full of ordinary points.
};
/// Block means.
std::vector<WeightedPoint> blockMeans(const FairFrame&);

struct CircleFit {
  Vec2 centre = Vec2::Zero();  ///< [px]
  double radius = 0.0;         ///< [px]
  double squares = 0.0;        ///< [px^2] Weighted sum of squared distances.
};
/// Geometric least squares circle (Gauss-Newton from the algebraic one). Absent for points on a line.
std::optional<CircleFit> fitCircle(std::span<const WeightedPoint>);
/// The circle as a periodic uniform quintic of 24 spans; radius exact to 1e-8, curvature to 1e-5. Starts next to
/// `first`, turns left if `left`.
UniformQuintic circleCurve(const CircleFit&, const Vec2& first, bool left);

struct LineFit {
  Vec2 point = Vec2::Zero(), direction = Vec2::UnitX();  ///< [px, unit vector]
  double squares = 0.0;                                  ///< [px^2] The same.
};
/// Total least squares line. Absent when all points are one.
std::optional<LineFit> fitLine(std::span<const WeightedPoint>);
/// The straight piece from the first to the last point: on the line, but through the pins.
Result<NurbsCurve> lineCurve(const LineFit&, const Vec2& first, const Vec2& last, const FairPins&);

/// For pieces too short for the fair fit: a polynomial through the points in order, straight below 12 px, of degree 2
/// below 25 px and 3 from there; raised, up to 5, while it misses the points by more than `tolerancePx` in the mean of
/// a few neighbours and the higher degree misses much less. Closed ones are a smooth loop. Ends exactly at the pins.
/// @return Numerical when the points are all one.
Result<NurbsCurve> simpleCurve(const FairData&, const FairPins&, double tolerancePx);

}  // namespace batten
