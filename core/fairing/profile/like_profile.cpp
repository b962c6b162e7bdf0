// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/like_profile.h"

#include <algorithm>
#include <cmath>

#include "core/curve/arc_length.h"
#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/profile/curve_comparison.h"

namespace batten {
namespace {

/// Fewer than a drawn profile may have.
constexpr int kShapePoints = 61;
/// Extent of a curve of length 1, for where its radius counts as without end.
constexpr double kUnitExtent = 0.5;

}  // namespace

std::vector<ProfilePoint> shapeOf(const NurbsCurve& curve) {
  std::vector<ProfilePoint> points;
  if (curve.isEmpty()) return points;
  const std::vector<CurveSample> samples = sampleByArcLength(curve, kShapePoints);
  const double length = samples.back().s;
  if (!(length > 0.0)) return points;
  for (const CurveSample& sample : samples)
    points.push_back({sample.s / length, std::isfinite(sample.kappa) ? sample.kappa * length : 0.0});
  points.front().fraction = 0.0;
  points.back().fraction = 1.0;
  return points;
}

std::vector<ProfilePoint> profileLike(std::span<const ProfilePoint> shape, const NurbsCurve& curve, bool closed) {
  std::vector<ProfilePoint> points;
  const TargetProfile wanted = drawnProfile(shape, closed);
  const ShapeProfile own = shapeProfile(curve, closed);
  if (!wanted.valid || own.curvature.empty()) return points;
  const ShapeComparison laid = compareShapes(own, shapeProfile(wanted, closed, 1.0, kUnitExtent));
  const double length = ArcLength(curve).total();
  const auto& curvature = laid.second.curvature;
  if (curvature.empty() || !(length > 0.0)) return points;
  const int count = static_cast<int>(curvature.size());
  for (int i = 0; i < kShapePoints; ++i) {
    const double f = static_cast<double>(i) / (kShapePoints - 1);
    const double place = f * (closed ? count : count - 1.0), below = std::floor(place);
    const auto at = [&](double k) {
      const int index = static_cast<int>(k);
      return curvature[closed ? index % count : std::min(index, count - 1)];
    };
    const double kappa = at(below) + (place - below) * (at(below + 1.0) - at(below));
    points.push_back({f, kappa / length});
  }
  return points;
}

}  // namespace batten
