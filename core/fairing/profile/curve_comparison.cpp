// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/curve_comparison.h"

#include <algorithm>
#include <cmath>

#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/fairing/profile/similarity.h"

namespace batten {
namespace {

/// |rho| counts as at most this many extents of the curve.
constexpr double kLargestRadius = 10.0;

/// How the second profile is laid over the first.
struct Alignment {
  bool mirrored = false, reversed = false;
  int shift = 0;
};

std::vector<double> laid(const std::vector<double>& values, const Alignment& alignment) {
  // Running through a curve the other way turns the sign of its curvature, as a reflection does.
  const double sign = alignment.mirrored != alignment.reversed ? -1.0 : 1.0;
  const int count = static_cast<int>(values.size());
  std::vector<double> result(values.size());
  for (int i = 0; i < count; ++i) {
    const int from = (alignment.reversed ? count - 1 - i + alignment.shift : i + alignment.shift) % count;
    result[i] = sign * values[from];
  }
  return result;
}

void addSample(ShapeProfile& profile, double kappa, double length, double largestRadius) {
  if (!std::isfinite(kappa)) kappa = 0.0;
  const double rho = std::abs(kappa) * largestRadius > 1.0 ? 1.0 / kappa : std::copysign(largestRadius, kappa);
  profile.radius.push_back(rho / length);
  profile.curvature.push_back(kappa * length);
}

}  // namespace

ShapeProfile shapeProfile(const NurbsCurve& curve, bool closed) {
  ShapeProfile profile;
  profile.closed = closed;
  if (curve.isEmpty()) return profile;
  const std::vector<CurveSample> samples = sampleByArcLength(curve, closed ? kShapeSamples + 1 : kShapeSamples);
  const double length = samples.back().s, largest = kLargestRadius * extent(curve);
  if (!(length > 0.0)) return profile;
  for (int i = 0; i < kShapeSamples; ++i) addSample(profile, samples[i].kappa, length, largest);
  return profile;
}

ShapeProfile shapeProfile(const TargetProfile& target, bool closed, double lengthMm, double extentMm) {
  ShapeProfile profile;
  profile.closed = closed;
  if (!target.valid || !(lengthMm > 0.0)) return profile;
  for (int i = 0; i < kShapeSamples; ++i) {
    const double f = static_cast<double>(i) / (closed ? kShapeSamples : kShapeSamples - 1);
    addSample(profile, target.curvatureAt(f), lengthMm, kLargestRadius * extentMm);
  }
  return profile;
}

ShapeComparison compareShapes(const ShapeProfile& first, const ShapeProfile& second) {
  ShapeComparison result;
  result.first = first;
  result.second = second;
  if (first.radius.empty() || first.radius.size() != second.radius.size()) return result;
  const int shifts = first.closed && second.closed ? static_cast<int>(second.radius.size()) : 1;
  Alignment best;
  double largest = -2.0;
  for (const bool reversed : {false, true}) {
    for (int shift = 0; shift < shifts; ++shift) {
      const double s = similarity(first.radius, laid(second.radius, {false, reversed, shift}));
      // A reflection turns the sign of S and changes nothing else. The first alignment found wins a tie.
      for (const bool mirrored : {false, true}) {
        const double value = mirrored ? -s : s;
        if (value > largest + 1e-12) largest = value, best = {mirrored, reversed, shift};
      }
    }
  }
  result.mirrored = best.mirrored;
  result.reversed = best.reversed;
  result.shift = static_cast<double>(best.shift) / static_cast<double>(second.radius.size());
  result.second.radius = laid(second.radius, best);
  result.second.curvature = laid(second.curvature, best);
  result.similarity = similarity(first.radius, result.second.radius);
  result.pearson = pearson(first.radius, result.second.radius);
  result.curvatureSimilarity = similarity(first.curvature, result.second.curvature);
  result.curvaturePearson = pearson(first.curvature, result.second.curvature);
  return result;
}

}  // namespace batten
