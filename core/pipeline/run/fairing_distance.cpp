// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/fairing_distance.h"

#include <algorithm>

#include "core/curve/closest_point.h"

namespace batten {

double startsOffMm(const TracedCurve& curve, CancelCheck check) {
  return curve.dense ? movedMm(*curve.dense, curve, check) : 0.0;
}

double movedMm(const NurbsCurve& moved, const TracedCurve& curve, CancelCheck check) {
  if (moved == curve.sketched) return 0.0;
  return std::max(deviation(moved, curve.sketched, check).max, deviation(curve.sketched, moved, check).max);
}

}  // namespace batten
