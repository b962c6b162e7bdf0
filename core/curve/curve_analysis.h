// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"
#include "core/curve/span_polynomials.h"

namespace batten {

/// Signed curvature at u in 1/unit, positive when the curve turns left in a frame with y up (conventions.h). Absent
/// where the first derivative vanishes; never NaN.
std::optional<double> curvature(const NurbsCurve&, double u);
/// Derivative of the curvature with respect to arc length. Absent where the first derivative vanishes.
std::optional<double> curvatureSlope(const NurbsCurve&, double u);

/// Arc length as a function of the parameter and back. Gauss-Legendre per polynomial span, subdivided until the
/// relative change is below 1e-10; inverse by safeguarded Newton.
class ArcLength {
 public:
  explicit ArcLength(const NurbsCurve&);
  double total() const { return total_; }
  double at(double u) const;         ///< Length from the start to u (clamped to the domain).
  double parameter(double s) const;  ///< u at length s (clamped to 0..total).

 private:
  SpanPolynomials curve_;
  std::vector<double> breaks_, cumulative_, speeds_;  ///< At the borders of the subdivision.
  double total_ = 0.0;
};

/// One sample of a curve. Units of the curve (mm in the model frame).
struct CurveSample {
  double u = 0.0, s = 0.0;
  Vec2 point = Vec2::Zero();
  Vec2 tangent = Vec2::UnitX();  ///< Unit direction of travel.
  double kappa = 0.0;            ///< 1/unit; 0 where the derivative vanishes.
  double speed = 0.0;            ///< |R'(u)|.
};
/// `count` samples at equal arc length, both ends included. @pre count >= 2.
std::vector<CurveSample> sampleByArcLength(const NurbsCurve&, int count);

struct ClosestPoint {
  double u = 0.0;
  double distance = 0.0;
  Vec2 point = Vec2::Zero();
};
/// Globally closest point: sampled start values, then safeguarded Newton; ends included.
ClosestPoint closestPoint(const NurbsCurve&, const Vec2&);

/// Distances of points from a curve, in its unit.
struct Deviation {
  double max = 0.0, rms = 0.0, percentile95 = 0.0;
  int count = 0;
  Vec2 worstPoint = Vec2::Zero();
};
/// @param ordered the points follow the curve from start to end (edge points do): searches locally, much faster.
Deviation deviation(const NurbsCurve&, std::span<const Vec2> points, bool ordered);
/// Largest and mean distance between two curves of similar course, sampled at equal arc length of `a` and projected on
/// `b`.
Deviation deviation(const NurbsCurve& a, const NurbsCurve& b);

struct CurvatureExtremumPoint {
  double u = 0.0, s = 0.0, kappa = 0.0;
  bool maximum = true;
};
/// Extrema of the signed curvature whose rise above both neighbouring extrema (or ends) exceeds `prominence` [1/unit].
/// Suggested prominence: 5e-3 / diagonal of the bounding box. `periodic`: the end continues at the start.
std::vector<CurvatureExtremumPoint> curvatureExtrema(const NurbsCurve&, double prominence, bool periodic);
/// Parameters of sign changes of the curvature that reach beyond +-`threshold` [1/unit] on both sides.
std::vector<double> inflections(const NurbsCurve&, double threshold, bool periodic);

/// Diagonal of the bounding box of the control points; the scale that relative tolerances refer to. > 0 for made curves
/// that are not a point.
double extent(const NurbsCurve&);

/// Largest difference between the curvatures of both sides of a joint (a knot inside the curve; closed: the seam too),
/// relative to the largest curvature at the joints and ends. 0 for a curve with one curvature at every joint (G2), up
/// to rounding; a joint at which a derivative vanishes does not count. @pre no corner inside the curve.
double largestCurvatureJump(const NurbsCurve&, bool closed);

}  // namespace batten
