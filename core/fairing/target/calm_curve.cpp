// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/calm_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/curve/curvature.h"
#include "core/fairing/model/coarse_setups.h"
#include "core/fairing/model/fairing_setup.h"

namespace batten {
namespace {

/// Share of the curve's control points that the calm curve may have: with more it bends as the tremor does, and what it
/// leaves of it says little of how large it is.
constexpr double kMostPoints = 1.0 / 3.0;

/// [mm^2] Mean square distance at equal shares of the arc length.
double meanSquareDistance(const FairingSetup& calm) {
  const FairingSetup& sketch = *calm.sketch;
  const int count = sketch.sampleCount();
  const double from = calm.original.start(), width = calm.original.end() - from;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const Vec2 at = sketch.reference.at(sketch.start.places[i], 0)[0];
    sum += (calm.original.point(from + sketch.fraction(i) * width) - at).squaredNorm();
  }
  return sum / std::max(count, 1);
}

}  // namespace

std::optional<NurbsCurve> withoutTremor(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                        CancelCheck check) {
  if (curve.isEmpty() || params.targets.spans == TargetSpans::Whole) return std::nullopt;
  if (params.targets.quantity != TargetQuantity::Curvature) return std::nullopt;
  if (params.means == FairingMeans::EdgeLengths) return std::nullopt;
  const int extrema = countedExtrema(curve, closed, check);
  if (extrema <= kMostSplits) return std::nullopt;
  const auto sketch = makeSetup(curve, closed, params, check);
  if (!sketch) return std::nullopt;
  std::shared_ptr<const FairingSetup> calm;
  double least = std::numeric_limits<double>::infinity();
  const double data = 2.0 * curve.controlPointCount();  // two coordinates each
  for (const auto& setup : coarseSetups(*sketch)) {
    if (check.isCancelled()) return std::nullopt;
    if (setup->basis.pointCount() > kMostPoints * curve.controlPointCount()) break;
    const double criterion =
        data * std::log(meanSquareDistance(*setup)) + 2.0 * setup->basis.pointCount() * std::log(data);
    if (!(criterion < least)) continue;
    least = criterion;
    calm = setup;
  }
  if (!calm || 2 * countedExtrema(calm->original, closed, check) >= extrema) return std::nullopt;
  return calm->original;
}

NurbsCurve targetStart(const NurbsCurve& curve, bool closed, const FairingParams& params, CancelCheck check) {
  auto calm = withoutTremor(curve, closed, params, check);
  if (!calm) return curve;
  return std::move(*calm);
}

}  // namespace batten
