// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

struct ClosestPoint {
  double u = 0.0;         ///< Parameter.
  double distance = 0.0;  ///< [unit of the curve] >= 0
  Vec2 point = Vec2::Zero();
};
/// Globally closest point: sampled start values, then safeguarded Newton; ends included. Takes time with the length of
/// the curve: for many points of one curve there is ClosestPointFinder.
ClosestPoint closestPoint(const NurbsCurve&, const Vec2&);

struct CurvePlace;
class StartTable;

/// closestPoint() for many points: what is sampled of the curve is kept, so that a point takes time with its logarithm.
class ClosestPointFinder {
 public:
  /// When the run is cancelled, the finder is of no use.
  explicit ClosestPointFinder(const NurbsCurve&, CancelCheck check = {});
  ClosestPoint closestTo(const Vec2&) const;
  /// What is sampled: two places or more, from the start of the curve to its end.
  const std::vector<CurvePlace>& places() const;

 private:
  std::shared_ptr<const StartTable> table_;
};

/// Distances of points from a curve, in its unit.
struct Deviation {
  double max = 0.0, rms = 0.0, percentile95 = 0.0;
  int count = 0;                   ///< Points measured.
  Vec2 worstPoint = Vec2::Zero();  ///< The point of the largest distance.
};
/// @param ordered the points follow the curve from start to end (edge points do): searches locally, much faster.
Deviation deviation(const NurbsCurve&, std::span<const Vec2> points, bool ordered, CancelCheck check = {});
/// Largest and mean distance of `a` from `b`, a curve of similar course, sampled at equal arc length of `a`; the
/// largest also between the samples, where the distance has its highest peaks.
Deviation deviation(const NurbsCurve& a, const NurbsCurve& b, CancelCheck check = {});

}  // namespace batten
