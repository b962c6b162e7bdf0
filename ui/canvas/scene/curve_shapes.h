// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainterPath>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/pipeline/run/pipeline.h"
#include "ui/session/view/judged_curve.h"

namespace batten {

/// A curve set with the frame it was made in; whichever of the two sets the session shows.
struct CurveSource {
  std::shared_ptr<const FairedSet> faired;
  std::shared_ptr<const ConstructedSet> constructed;
  PageFrame frame;
  const std::vector<TracedCurve>& curves() const;
  bool operator==(const CurveSource&) const = default;
};

/// A curve as lines in image px, fine enough for one zoom bracket.
struct CurveShape {
  QPainterPath sketched, faired;  ///< `faired` is empty where it equals the sketched curve.
  QRectF bounds;                  ///< [px] of both.
  bool isIncluded = true;
};
struct CurveShapes {
  CurveSource source;
  double zoom = 0.0;  ///< Made for zooms up to this.
  std::vector<CurveShape> curves;
};

/// The zoom for which shapes are made: the power of two not below `zoom`.
double zoomBracket(double zoom);
/// Lines in image px that stay within `tolerancePx` of the curve (by the second derivative in each span).
QPainterPath sampledPath(const NurbsCurve&, const PageFrame&, double tolerancePx);
/// All curves at a bracket. Null when cancelled.
std::shared_ptr<const CurveShapes> buildShapes(const CurveSource&, double bracket, const RunContext&);

/// A place along a curve.
struct CombPoint {
  Vec2 px = Vec2::Zero();
  Vec2 outPx = Vec2::Zero();         ///< Unit, image frame: the side on which positive curvature is drawn (outwards).
  double kappa = 0.0;                ///< [1/mm]
  double s = 0.0;                    ///< [mm]
  std::optional<double> sigma = {};  ///< [1/mm] noise of the curvature, where it is known.
};
struct CombMark {
  Vec2 px = Vec2::Zero(), outPx = Vec2::Zero();
  double kappa = 0.0;
  bool isInflection = false;
};
/// From a place of the sketched curve to the nearest of the faired one.
struct Whisker {
  Vec2 fromPx = Vec2::Zero(), toPx = Vec2::Zero();
  double mm = 0.0;
  double s = 0.0;  ///< [mm] on the faired curve.
};
/// What is drawn and read along one curve: equal steps of arc length of the judged curve.
struct CurveComb {
  int index = 0;  ///< Of the curve in its set.
  bool isFaired = false;
  double lengthMm = 0.0;
  double extentPx = 0.0;
  double robustKappa = 0.0;  ///< [1/mm] 95 % of |kappa|.
  std::vector<CombPoint> points;
  std::vector<CombPoint> sketched;  ///< Of the sketched curve, when a faired one is judged.
  std::vector<CombMark> marks;
  std::vector<Whisker> whiskers;  ///< Selected curve only.
  CombPoint at(double s) const;   ///< Interpolated; @pre points not empty.
};
struct CurveCombs {
  CurveSource source;
  std::optional<int> selected;
  Judged judged = Judged::Result;  ///< Whose combs they are.
  std::vector<CurveComb> combs;
  const CurveComb* of(int index) const;
};
/// Combs of the selected curve, or of all when there are few. Null when cancelled.
std::shared_ptr<const CurveCombs> buildCombs(const CurveSource&, std::optional<int> selected, Judged,
                                             const RunContext&);

/// Nearest place of a polyline.
struct NearPoint {
  double distance = 0.0;  ///< Same unit as the points.
  double position = 0.0;  ///< Index + fraction.
};
std::optional<NearPoint> nearestOn(const std::vector<CombPoint>&, const Vec2& px);
std::optional<double> distanceTo(const QPainterPath&, const Vec2& px);

}  // namespace batten
