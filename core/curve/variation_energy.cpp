// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/variation_energy.h"

#include <cmath>
#include <vector>

#include "core/curve/curvature.h"
#include "core/solve/gauss_legendre.h"

namespace batten {
namespace {

constexpr auto kFivePoints = gaussLegendre<5>();  // of a part
constexpr int kEnergyPartsPerSpan = 4;  // the integrand is a quotient, which no rule takes exactly: short parts

}  // namespace

double variationEnergy(const NurbsCurve& curve) {
  if (curve.isEmpty()) return 0.0;
  const std::vector<double> breaks = curve.breaks();
  double energy = 0.0, length = 0.0;
  for (std::size_t span = 0; span + 1 < breaks.size(); ++span) {
    const double part = (breaks[span + 1] - breaks[span]) / kEnergyPartsPerSpan;
    for (int k = 0; k < kEnergyPartsPerSpan; ++k) {
      const double middle = breaks[span] + (k + 0.5) * part;
      for (std::size_t g = 0; g < kFivePoints.node.size(); ++g) {
        const double u = middle + 0.5 * part * kFivePoints.node[g];
        const double ds = 0.5 * part * kFivePoints.weight[g] * curve.derivatives(u, 1)[1].norm();
        length += ds;
        if (const auto slope = curvatureSlope(curve, u)) energy += *slope * *slope * ds;
      }
    }
  }
  const double result = energy * length * length * length;
  return std::isfinite(result) ? result : 0.0;
}

}  // namespace batten
