// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/similarity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace batten {
namespace {

double meanOf(std::span<const double> values, std::size_t count) {
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += values[i];
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// The cosine of the angle between a - shiftA and b - shiftB; 0 where either vanishes against `floorA`, `floorB`.
double cosine(std::span<const double> a, std::span<const double> b, double shiftA, double shiftB) {
  const std::size_t count = std::min(a.size(), b.size());
  double scaleA = 0.0, scaleB = 0.0, sizeA = 0.0, sizeB = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    scaleA = std::max(scaleA, std::abs(a[i] - shiftA));
    scaleB = std::max(scaleB, std::abs(b[i] - shiftB));
    sizeA = std::max(sizeA, std::abs(a[i]));
    sizeB = std::max(sizeB, std::abs(b[i]));
  }
  // What is left after centring a constant is rounding, not shape.
  constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();
  if (!(scaleA > kRounding * sizeA) || !(scaleB > kRounding * sizeB)) return 0.0;
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = (a[i] - shiftA) / scaleA, y = (b[i] - shiftB) / scaleB;
    ab += x * y;
    aa += x * x;
    bb += y * y;
  }
  const double result = ab / (std::sqrt(aa) * std::sqrt(bb));
  return std::isfinite(result) ? std::clamp(result, -1.0, 1.0) : 0.0;
}

}  // namespace

double similarity(std::span<const double> a, std::span<const double> b) { return cosine(a, b, 0.0, 0.0); }

double pearson(std::span<const double> a, std::span<const double> b) {
  const std::size_t count = std::min(a.size(), b.size());
  return cosine(a, b, meanOf(a, count), meanOf(b, count));
}

std::optional<double> aicc(double meanSquareResidual, int degree, int effectiveSamples) {
  const double n = effectiveSamples, k = degree + 2;
  if (!(n - k - 1 > 0) || !std::isfinite(meanSquareResidual)) return std::nullopt;
  const double meanSquare = std::max(meanSquareResidual, std::numeric_limits<double>::min());
  return n * std::log(meanSquare) + 2 * k + 2 * k * (k + 1) / (n - k - 1);
}

}  // namespace batten
