// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/calm_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/curve/curvature.h"
#include "core/fairing/model/coarse_setups.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/profile/similarity.h"
#include "core/fairing/target/natural_spans.h"

namespace batten {
namespace {

/// [mm^2] Mean square distance at equal shares of the arc length.
double meanSquareDistance(const FairingSetup& calm) {
  const FairingSetup& sketch = *calm.sketch;
  const int count = sketch.sampleCount();
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double u = calm.original.start() + sketch.fraction(i) * (calm.original.end() - calm.original.start());
    sum += (calm.original.point(u) - sketch.reference.at(sketch.start.places[i], 0)[0]).squaredNorm();
  }
  return sum / std::max(count, 1);
}

}  // namespace

NurbsCurve withoutTremor(const NurbsCurve& curve, bool closed, const FairingParams& params, CancelCheck check) {
  const bool isWhole = params.targets.spans == TargetSpans::Whole;
  if (curve.isEmpty() || isWhole || params.targets.quantity != TargetQuantity::Curvature) return curve;
  if (countedExtrema(curve, closed, check) <= kMostSplits) return curve;
  const auto sketch = makeSetup(curve, closed, params, check);
  if (!sketch) return curve;
  NurbsCurve calm = curve;
  double least = std::numeric_limits<double>::infinity();
  const int data = 2 * curve.controlPointCount();  // two coordinates each
  for (const auto& setup : coarseSetups(*sketch)) {
    const int parameters = 2 * setup->basis.pointCount();
    if (parameters + 1 >= data) break;
    const double criterion = aicc(meanSquareDistance(*setup), parameters - 1, data);
    if (!(criterion < least)) continue;
    least = criterion;
    calm = setup->original;
  }
  return calm;
}

}  // namespace batten
