// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/scene/comb_runs.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kAutomaticHeight = 0.13;  ///< Of the curve's extent, for the 95 % curvature at scale 1.
constexpr double kLeastHeight = 0.03;      ///< The same where the curve has a great many bends.
constexpr double kCutHeight = 1.7;         ///< Of the automatic height: a sharp bend does not fill the drawing.
constexpr double kCutOfView = 0.4;         ///< Nothing is taller than this share of the view, however near one comes.
constexpr double kSpikeShare = 0.03;       ///< Of the comb's points: a cut run up to this is a spike.

}  // namespace

double CombScale::heightOf(double kappa) const {
  if (!(pxPerRadius > 0.0)) return std::clamp(kappa * pxPerKappa, -limitPx, limitPx);
  return cuts(kappa) ? std::copysign(limitPx, kappa) : pxPerRadius / kappa;
}

bool CombScale::cuts(double kappa) const {
  if (pxPerRadius > 0.0) return !(std::abs(kappa) * limitPx >= pxPerRadius);
  return std::abs(kappa) * pxPerKappa > limitPx;
}

double CombScale::limitKappa() const { return pxPerRadius > 0.0 ? pxPerRadius / limitPx : limitPx / pxPerKappa; }

std::vector<CombRun> combRuns(const std::vector<CombPoint>& points, const CombScale& scale) {
  std::vector<CombRun> runs;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool isCut = scale.cuts(points[i].kappa);
    // Quills to the other side are another spike.
    const bool continues = !runs.empty() && runs.back().isCut == isCut &&
                           !(isCut && (points[i].kappa > 0.0) != (points[i - 1].kappa > 0.0));
    if (!continues) runs.push_back({i, i, i, isCut, false});
    CombRun& run = runs.back();
    run.last = i;
    if (std::abs(points[i].kappa) > std::abs(points[run.peak].kappa)) run.peak = i;
  }
  for (CombRun& run : runs)
    run.isSpike =
        run.isCut && static_cast<double>(run.last - run.first + 1) <= kSpikeShare * static_cast<double>(points.size());
  return runs;
}

CombPoint combCrossing(const CombPoint& uncut, const CombPoint& cut, const CombScale& scale) {
  const double limit = std::copysign(scale.limitKappa(), scale.pxPerRadius > 0.0 ? uncut.kappa : cut.kappa);
  const double rise = cut.kappa - uncut.kappa;
  const double t = rise != 0.0 ? std::clamp((limit - uncut.kappa) / rise, 0.0, 1.0) : 0.0;
  CombPoint at = uncut;
  at.px = uncut.px + t * (cut.px - uncut.px);
  at.s = uncut.s + t * (cut.s - uncut.s);
  at.kappa = uncut.kappa + t * rise;
  const Vec2 out = uncut.outPx + t * (cut.outPx - uncut.outPx);
  if (out.norm() > 0.0) at.outPx = out.normalized();
  return at;
}

CombScale radiusScaleFor(const CombedCurve& curve, const std::vector<CombPoint>& points, double wantedScale,
                         double viewPx) {
  const CombScale curvature = combScaleFor(curve, wantedScale, viewPx);
  std::vector<double> radii;
  for (const CombPoint& point : points)
    if (std::abs(point.kappa) > 0.0) radii.push_back(1.0 / std::abs(point.kappa));
  if (!(curvature.pxPerKappa > 0.0) || radii.empty()) return {};
  CombScale scale;
  scale.limitPx = curvature.limitPx;
  scale.pxPerRadius = curvature.pxPerKappa * curve.robustKappa / upperMedian(radii);
  return scale;
}

CombScale combScaleFor(const CombedCurve& curve, double wantedScale, double viewPx) {
  if (!(curve.robustKappa > 0.0) || !(curve.extentPx > 0.0)) return {};
  const double bend = curve.lengthPx / (1.0 + std::max(0, curve.extrema));
  const double height = std::clamp(bend, kLeastHeight * curve.extentPx, kAutomaticHeight * curve.extentPx);
  CombScale scale;
  scale.pxPerKappa = height * wantedScale / curve.robustKappa;
  // Who makes the comb lower sees more of its spikes; who makes it taller wants them taller.
  scale.limitPx = std::min(kCutHeight * height * std::max(1.0, wantedScale), kCutOfView * viewPx);
  return scale;
}

}  // namespace batten
