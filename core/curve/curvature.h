// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Signed curvature at u in 1/unit, positive when the curve turns left in a frame with y up (conventions.h). Absent
/// where the first derivative vanishes; never NaN.
std::optional<double> curvature(const NurbsCurve&, double u);
/// Derivative of the curvature with respect to arc length. Absent where the first derivative vanishes.
std::optional<double> curvatureSlope(const NurbsCurve&, double u);

/// [1/extent] A smaller rise of the curvature is seen by no eye and in no reflection: extrema, inflections and their
/// counts everywhere take this over the extent of the curve.
inline constexpr double kExtremumProminence = 5e-3;

struct CurvatureExtremumPoint {
  double u = 0.0, s = 0.0, kappa = 0.0;  ///< Parameter, arc length, signed curvature [1/unit].
  bool maximum = true;                   ///< Of the signed curvature; else a minimum.
};
/// Extrema of the signed curvature whose rise above both neighbouring extrema (or ends) exceeds `prominence` [1/unit].
/// Usual prominence: kExtremumProminence / extent. `periodic`: the end continues at the start.
std::vector<CurvatureExtremumPoint> curvatureExtrema(const NurbsCurve&, double prominence, bool periodic,
                                                     CancelCheck check = {});
/// Number of extrema of the usual prominence; 0 for a point.
int countedExtrema(const NurbsCurve&, bool periodic, CancelCheck check = {});
/// Parameters of sign changes of the curvature that reach beyond +-`threshold` [1/unit] on both sides.
std::vector<double> inflections(const NurbsCurve&, double threshold, bool periodic, CancelCheck check = {});

struct CurvatureCounts {
  int extrema = 0, inflections = 0;
};

/// How many there are of curvatureExtrema and of inflections, with the prominence as their threshold: from one look at
/// the curve, and without the places, which cost more than the counts.
CurvatureCounts curvatureCounts(const NurbsCurve&, double prominence, bool periodic, CancelCheck check = {});

/// Diagonal of the bounding box of the control points; the scale that relative tolerances refer to. > 0 for made curves
/// that are not a point.
double extent(const NurbsCurve&);

}  // namespace batten
