// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/scene/curve_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"

namespace batten {
namespace {

constexpr int kCombSamples = 801;        // along a curve
constexpr int kWhiskers = 121;           // of a comb
constexpr double kMostCurvature = 0.95;  ///< Of the samples: what a few spikes do not raise.
constexpr std::size_t kFewCurves = 6;    ///< All combs are shown up to this many curves.

double squaredToSegment(const Vec2& p, const Vec2& a, const Vec2& b, double& fraction) {
  const Vec2 d = b - a;
  const double length = d.squaredNorm();
  fraction = length > 0.0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0.0;
  return (p - a - fraction * d).squaredNorm();
}

CombPoint combPoint(const CurveSample& sample, const PageFrame& frame) {
  CombPoint point;
  point.px = frame.pointToImage(sample.point);
  const Vec2 outward = frame.vectorToImage(-leftNormal(sample.tangent));
  const double length = outward.norm();
  if (length > 0.0) point.outPx = outward / length;
  point.kappa = sample.kappa;
  point.s = sample.s;
  return point;
}

std::vector<CombPoint> combPoints(const NurbsCurve& curve, const PageFrame& frame) {
  std::vector<CombPoint> points;
  for (const CurveSample& sample : sampleByArcLength(curve, kCombSamples)) points.push_back(combPoint(sample, frame));
  return points;
}

/// Gives the points of a sketched curve the noise that its construction measured.
void addNoise(std::vector<CombPoint>& points, const ConstructReport& report) {
  const std::vector<NoiseNote>& noise = report.noise;
  if (noise.size() < 2) return;
  for (CombPoint& point : points) {
    const auto next = std::ranges::upper_bound(noise.begin() + 1, noise.end() - 1, point.s, {}, &NoiseNote::s);
    const NoiseNote &low = *(next - 1), &high = *next;
    const double width = high.s - low.s;
    const double t = width > 0.0 ? std::clamp((point.s - low.s) / width, 0.0, 1.0) : 0.0;
    const double value = low.sigma + t * (high.sigma - low.sigma);
    if (std::isfinite(value)) point.sigma = value;
  }
}

CombMark markAt(const CurveComb& comb, double s, double kappa, bool isInflection) {
  const CombPoint place = comb.at(s);
  return {place.px, place.outPx, kappa, isInflection};
}

void addMarks(CurveComb& comb, const NurbsCurve& curve, bool closed) {
  const double size = extent(curve);
  if (!(size > 0.0)) return;
  const double prominence = kExtremumProminence / size;
  for (const auto& extremum : curvatureExtrema(curve, prominence, closed))
    comb.marks.push_back(markAt(comb, extremum.s, extremum.kappa, false));
  const auto turns = inflections(curve, prominence, closed);
  if (turns.empty()) return;
  const ArcLength lengths(curve);
  for (const double u : turns) comb.marks.push_back(markAt(comb, lengths.at(u), 0.0, true));
}

CurveComb combOf(const TracedCurve& traced, int index, bool isSelected, Judged judged, const PageFrame& frame) {
  CurveComb comb;
  comb.index = index;
  comb.isFaired = judged == Judged::Result && isChanged(traced);
  const NurbsCurve& shown = judgedCurve(traced, judged);
  comb.points = combPoints(shown, frame);
  if (comb.points.empty()) return comb;
  if (!comb.isFaired) addNoise(comb.points, traced.construct);
  comb.lengthMm = comb.points.back().s;
  comb.extentPx = frame.lengthToImage(extent(shown));
  std::vector<double> sizes;
  for (const CombPoint& point : comb.points) sizes.push_back(std::abs(point.kappa));
  comb.robustKappa = lowerQuantile(sizes, kMostCurvature);
  addMarks(comb, shown, traced.closed);
  if (!comb.isFaired || !isSelected) return comb;
  comb.sketched = combPoints(traced.sketched, frame);
  addNoise(comb.sketched, traced.construct);
  const ClosestPointFinder finder(traced.sketched);
  for (const CurveSample& sample : sampleByArcLength(traced.faired, kWhiskers)) {
    const ClosestPoint nearest = finder.closestTo(sample.point);
    comb.whiskers.push_back(
        {frame.pointToImage(nearest.point), frame.pointToImage(sample.point), nearest.distance, sample.s});
  }
  return comb;
}

}  // namespace

const std::vector<TracedCurve>& CurveSource::curves() const {
  static const std::vector<TracedCurve> none;
  return faired ? faired->curves : constructed ? constructed->curves : none;
}

double zoomBracket(double zoom) { return std::exp2(std::ceil(std::log2(std::max(zoom, 1e-3)))); }

QPainterPath sampledPath(const NurbsCurve& curve, const PageFrame& frame, double tolerancePx) {
  QPainterPath path;
  if (curve.isEmpty()) return path;
  const auto place = [&](double u) {
    const Vec2 px = frame.pointToImage(curve.point(u));
    return QPointF(px.x(), px.y());
  };
  const std::vector<double> breaks = curve.breaks();
  path.moveTo(place(curve.start()));
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double from = breaks[i], span = breaks[i + 1] - breaks[i];
    double bend = 0.0;
    for (const double t : {0.02, 0.25, 0.5, 0.75, 0.98}) {
      const Vec2 second = curve.derivatives(from + t * span, 2)[2];
      bend = std::max(bend, frame.lengthToImage(second.norm()) * span * span);
    }
    // Height of an arc over its chord: |R''| h^2 / 8; the factor covers the variation between the five places.
    const double wanted = std::sqrt(1.5 * bend / (8.0 * tolerancePx));
    const int steps = std::clamp(static_cast<int>(std::ceil(wanted)), 1, 256);
    for (int k = 1; k <= steps; ++k) path.lineTo(place(from + span * k / steps));
  }
  return path;
}

std::shared_ptr<const CurveShapes> buildShapes(const CurveSource& source, double bracket, const RunContext& context) {
  auto shapes = std::make_shared<CurveShapes>();
  shapes->source = source;
  shapes->zoom = bracket;
  const auto& curves = source.curves();
  shapes->curves.resize(curves.size());
  const double tolerance = 0.15 / bracket;
  parallelFor(context, static_cast<int>(curves.size()), 4, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const TracedCurve& traced = curves[i];
      CurveShape& shape = shapes->curves[i];
      shape.isIncluded = traced.included;
      shape.sketched = sampledPath(traced.sketched, source.frame, tolerance);
      if (isChanged(traced)) shape.faired = sampledPath(traced.faired, source.frame, tolerance);
      shape.bounds = shape.sketched.controlPointRect().united(shape.faired.controlPointRect());
    }
  });
  if (context.isCancelled()) return nullptr;
  return shapes;
}

std::shared_ptr<const CurveCombs> buildCombs(const CurveSource& source, std::optional<int> selected, Judged judged,
                                             const RunContext& context) {
  auto combs = std::make_shared<CurveCombs>();
  combs->source = source;
  combs->selected = selected;
  combs->judged = judged;
  const auto& curves = source.curves();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const int index = static_cast<int>(i);
    if (curves[i].sketched.isEmpty() || (index != selected && (curves.size() > kFewCurves || !curves[i].included)))
      continue;
    if (context.isCancelled()) return nullptr;
    combs->combs.push_back(combOf(curves[i], index, index == selected, judged, source.frame));
  }
  return combs;
}

CombPoint CurveComb::at(double s) const {
  const auto next =
      std::lower_bound(points.begin(), points.end(), s, [](const CombPoint& p, double v) { return p.s < v; });
  if (next == points.begin()) return points.front();
  if (next == points.end()) return points.back();
  const CombPoint &a = *(next - 1), &b = *next;
  const double t = b.s > a.s ? (s - a.s) / (b.s - a.s) : 0.0;
  CombPoint mixed;
  mixed.px = a.px + t * (b.px - a.px);
  mixed.outPx = a.outPx + t * (b.outPx - a.outPx);
  if (mixed.outPx.norm() > 0.0) mixed.outPx.normalize();
  mixed.kappa = a.kappa + t * (b.kappa - a.kappa);
  mixed.s = s;
  return mixed;
}

const CurveComb* CurveCombs::of(int index) const {
  for (const CurveComb& comb : combs)
    if (comb.index == index && !comb.points.empty()) return &comb;
  return nullptr;
}

std::optional<NearPoint> nearestOn(const std::vector<CombPoint>& points, const Vec2& px) {
  std::optional<NearPoint> best;
  double bestSquare = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    double fraction = 0.0;
    const double square = squaredToSegment(px, points[i].px, points[i + 1].px, fraction);
    if (square >= bestSquare) continue;
    bestSquare = square;
    best = NearPoint{std::sqrt(square), static_cast<double>(i) + fraction};
  }
  return best;
}

std::optional<double> distanceTo(const QPainterPath& path, const Vec2& px) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i + 1 < path.elementCount(); ++i) {
    const auto a = path.elementAt(i), b = path.elementAt(i + 1);
    double fraction = 0.0;
    best = std::min(best, squaredToSegment(px, {a.x, a.y}, {b.x, b.y}, fraction));
  }
  if (!std::isfinite(best)) return std::nullopt;
  return std::sqrt(best);
}

}  // namespace batten
