// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/base/cancel_check.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

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
Deviation deviation(const NurbsCurve&, std::span<const Vec2> points, bool ordered, CancelCheck check = {});
/// Largest and mean distance of `a` from `b`, a curve of similar course, sampled at equal arc length of `a`; the largest
/// also between the samples, where the distance has its highest peaks.
Deviation deviation(const NurbsCurve& a, const NurbsCurve& b, CancelCheck check = {});

}  // namespace batten
