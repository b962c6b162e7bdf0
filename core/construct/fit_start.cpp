// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fit_start.h"

#include <algorithm>
#include <cmath>

#include "core/construct/fair/fair_fit.h"
#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/curve/foot_step.h"

namespace batten {
namespace {

constexpr double kFewestLineSteps = 8.0, kMostLineSteps = 2e6;  // about one a pixel, of a curve
constexpr double kBackwardCost = 100.0;  // times the squared distance: a place where the curve runs the other way

/// The fit of one piece, sampled every pixel.
class FittedLine {
 public:
  FittedLine(const NurbsCurve& curve, bool closed)
      : curve_(curve), length_(curve), closed_(closed), total_(length_.total()) {
    const double count = std::clamp(std::ceil(total_), kFewestLineSteps, kMostLineSteps);
    samples_ = sampleByArcLength(curve, static_cast<int>(count) + 1);
  }

  std::vector<Vec2> points() const {
    std::vector<Vec2> points;
    points.reserve(samples_.size());
    for (const CurveSample& sample : samples_) points.push_back(sample.point);
    if (closed_) points.pop_back();
    return points;
  }

  Station foot(const Station& station) const {
    // Stations at equal distance stay so: beside the curve they are apart by their noise, too.
    const double s = station.along ? *station.along * total_ : polished(nearest(station).s, station.point);
    const double u = parameter(s);
    Station moved = station;
    moved.point = curve_.point(u);
    if (const Vec2 d = curve_.derivatives(u, 1)[1]; d.norm() > 0.0) moved.direction = d.normalized();
    moved.from = moved.point - (station.point - station.from).norm() * moved.direction;
    moved.to = moved.point + (station.to - station.point).norm() * moved.direction;
    return moved;
  }

 private:
  double parameter(double s) const { return length_.parameter(closed_ ? s - total_ * std::floor(s / total_) : s); }

  /// The nearest sample that runs the station's way.
  const CurveSample& nearest(const Station& station) const {
    const CurveSample* best = nullptr;
    double least = 0.0;
    for (const CurveSample& sample : samples_) {
      const double along = sample.tangent.dot(station.direction);
      const double distance = (sample.point - station.point).squaredNorm() * (along > 0.0 ? 1.0 : kBackwardCost);
      if (best && distance >= least) continue;
      best = &sample;
      least = distance;
    }
    return best ? *best : samples_.front();
  }

  /// [px] along the curve: the foot point of `point` near s, by Newton steps of a few pixels at most.
  double polished(double s, const Vec2& point) const {
    const double reach = 2.0 * total_ / static_cast<double>(samples_.size());
    for (int i = 0; i < 4; ++i) {
      const double u = parameter(s);
      const auto here = curve_.derivatives(u, 1);
      if (!(here[1].norm() > 0.0)) return s;
      const Vec2 tangent = here[1].normalized(), bend = curvature(curve_, u).value_or(0.0) * leftNormal(tangent);
      s += std::clamp(footStep(here[0] - point, tangent, bend), -reach, reach);
      if (!closed_) s = std::clamp(s, 0.0, total_);
    }
    return s;
  }

  const NurbsCurve& curve_;
  ArcLength length_;
  bool closed_;
  double total_;
  std::vector<CurveSample> samples_;
};

}  // namespace

Result<ConstructContour> onFairFit(const ConstructContour& contour, const ConstructParams& params,
                                   const RunContext& context) {
  FairFitOptions options;
  options.extremumSignificance = params.extremumSignificance;
  options.knotRemovalTolerance = 0.0;
  auto fits = fairFit(contour, options, context);
  if (!fits) return fail(std::move(fits.error()));
  ConstructContour onFit = contour;
  for (std::size_t i = 0; i < fits->size() && !context.isCancelled(); ++i) {
    ConstructPiece& piece = onFit.pieces[i];
    const FittedLine line((*fits)[i].curve, piece.closed);
    piece.points = piecePoints(line.points());
    piece.isDrawn = false;
    for (Station& station : piece.stations) station = line.foot(station);
  }
  if (context.isCancelled()) return cancelled();
  return onFit;
}

}  // namespace batten
