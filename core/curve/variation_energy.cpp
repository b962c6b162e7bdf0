// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/variation_energy.h"

#include <array>
#include <cmath>
#include <vector>

#include "core/curve/curvature.h"

namespace batten {
namespace {

/// Abscissae and weights of five points on [-1, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 5> kGaussFiveNodes = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                                   0.9061798459386640};
constexpr std::array<double, 5> kGaussFiveWeights = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                                     0.4786286704993665, 0.2369268850561891};
constexpr int kEnergyPartsPerSpan = 4;

}  // namespace

double variationEnergy(const NurbsCurve& curve) {
  if (curve.isEmpty()) return 0.0;
  const std::vector<double> breaks = curve.breaks();
  double energy = 0.0, length = 0.0;
  for (std::size_t span = 0; span + 1 < breaks.size(); ++span) {
    const double part = (breaks[span + 1] - breaks[span]) / kEnergyPartsPerSpan;
    for (int k = 0; k < kEnergyPartsPerSpan; ++k) {
      const double middle = breaks[span] + (k + 0.5) * part;
      for (std::size_t g = 0; g < kGaussFiveNodes.size(); ++g) {
        const double u = middle + 0.5 * part * kGaussFiveNodes[g];
        const double ds = 0.5 * part * kGaussFiveWeights[g] * curve.derivatives(u, 1)[1].norm();
        length += ds;
        if (const auto slope = curvatureSlope(curve, u)) energy += *slope * *slope * ds;
      }
    }
  }
  const double result = energy * length * length * length;
  return std::isfinite(result) ? result : 0.0;
}

}  // namespace batten
