// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"
#include "core/curve/span_polynomials.h"

namespace batten {

/// Arc length as a function of the parameter and back. Gauss-Legendre per polynomial span, subdivided until the
/// relative change is below 1e-10; inverse by safeguarded Newton.
class ArcLength {
 public:
  /// When the run is cancelled, the lengths are of no use.
  explicit ArcLength(const NurbsCurve&, CancelCheck check = {});
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
  double u = 0.0, s = 0.0;  ///< Parameter; arc length from the start.
  Vec2 point = Vec2::Zero();
  Vec2 tangent = Vec2::UnitX();  ///< Unit direction of travel.
  double kappa = 0.0;            ///< 1/unit; 0 where the derivative vanishes.
  double speed = 0.0;            ///< |R'(u)|.
};
/// `count` samples at equal arc length, both ends included. @pre count >= 2.
std::vector<CurveSample> sampleByArcLength(const NurbsCurve&, int count, CancelCheck check = {});

}  // namespace batten
