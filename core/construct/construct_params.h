// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/result.h"

namespace batten {

enum class ConstructMethod {
  Fair,            ///< True and fair fit of the edge points themselves (default for traced lines).
  Nurbs,           ///< Quintic NURBS from points and gradients (000, 003).
  Bezier,          ///< Quadratic Bezier path elevated to degree 5 (001).
  Typical,         ///< Chain of typical curves (002).
  ControlPolygon,  ///< The points as control polygon with repeated knots at sharp points (004).
};

/// What the papers' constructions take for the line.
enum class ConstructStart {
  Line,  ///< The edge points, as in the papers (default).
  Fit,   ///< Points and directions of the true and fair fit of the edge points.
};

/// How the quintic NURBS uses the gradients (003 section 3).
enum class GradientUse {
  All,          ///< Points and all gradients (000).
  Four,         ///< All points, gradients at the first two and the last two.
  NaturalEnds,  ///< Points only, R'' = R'''' = 0 at the ends.
  Directions,   ///< Points and directions; the lengths of the derivatives count less (uneven stations on even knots).
};

/// How far the curves of stations go.
enum class ConstructEnds {
  Line,      ///< To the ends of the line (default).
  Stations,  ///< From the first station to the last, none of them held: m stations give m + 4 control points (000).
};

/// How a chain of typical curves comes about.
enum class TypicalMode {
  Chain,    ///< All segments fitted together (default).
  Growing,  ///< One after the other: seed, extrapolation, fit, until the normals deviate (002 section 6).
};

/// What the knot vector of a control polygon does at a sharp point (004 section 4).
enum class SharpKnots {
  Degree,   ///< A knot of multiplicity = degree: the curve passes through the point with a corner (default).
  Order,    ///< Multiplicity = degree + 1, as in the paper: the curve is broken between the point and the one before.
  Uniform,  ///< Equal steps everywhere, ends included: the curve passes through no point (only for comparison).
};

/// How the points of a control polygon are thinned (004 section 3.1).
enum class PointRemoval {
  Step,       ///< Points at equal distance along the line.
  Tolerance,  ///< As few as keep the polygon within a distance of the line.
};

/// One flat set for all methods; each method reads its own fields.
struct ConstructParams {
  ConstructMethod method = ConstructMethod::Fair;
  ConstructStart start =
      ConstructStart::Line;          ///< Nurbs, Bezier and control polygon; chains always start from the fit.
  double derivativeMagnitude = 1.0;  ///< [-] 0.1..3. Factor on the arc-corrected length of the first derivative.
  bool magnitudeAsInPaper = false;   ///< 1/3 of the mean distance of adjacent points instead (000; wrong by 3).
  GradientUse gradients = GradientUse::All;
  /// Bezier without low pass: both sides of a joint take the mean of their curvatures. Off: the path before that
  /// (001 Fig. 11 to 14), whose curvature jumps.
  bool equaliseJoints = true;
  ConstructEnds ends = ConstructEnds::Line;  ///< Nurbs, Bezier; open lines.
  int degree = 3;                            ///< 2..5. Control polygon only, as the next four.
  SharpKnots knots = SharpKnots::Degree;
  PointRemoval removal = PointRemoval::Step;
  double removalStepPx = 8.0;       ///< [px] 0..200. Distance of the points that are kept; 0 keeps all.
  double removalTolerancePx = 1.0;  ///< [px] 0..50. Farthest that a removed point lies from the polygon.
  double lowPass =
      1.0;  ///< [stations] 0..8. Bezier path: standard deviation of the low pass of its curvature; 0 = none.
  /// [px] 0..50. Nurbs, Bezier: where the curve leaves the line by more (and by more than its noise), stations are set
  /// closer, and the report says where that did not help; 0 = never (papers).
  double maxDeviationPx = 2.0;
  TypicalMode typical = TypicalMode::Chain;
  double growingStopDeg = 2.0;    ///< [degrees] 0.2..20. Growing: the normals of curve and points may differ by this.
  bool growingAsInPaper = false;  ///< Growing: keeps each fit whole (002; unstable) instead of its first half.
  /// [chi2] 1..1000. Fair fit: a curvature extremum cheaper than this is dropped, on lines of 2000 px and shorter; a
  /// little more is asked on longer ones (ExtremumNote::askedCost).
  double extremumSignificance = 20.0;
  /// [-] 0..1. Fair fit: part of the noise of an edge point by which the curve may move to need fewer control points;
  /// 0 keeps them all. Without light curves; the dense curve of a light one has its default.
  double knotRemovalTolerance = 0.25;
  /// Fair fit: the fewest control points that hold the tolerance below and keep the extrema of the curvature.
  bool light = true;
  /// [px] 0.005..50. Light curves: farthest that a light curve lies from the dense one.
  double lightTolerancePx = 0.05;
  /// [-] 0..1. Light curves: from true to the ink (0: the tolerance above) to what was meant (1: a quarter of the width
  /// of the ink). Between them the tolerance grows by equal factors; what is smaller than it is smoothed away, and
  /// sharp corners of its size stay sharp.
  double detail = 0.0;
  /// Light curves: ragged outlines of uneven ink (ConstructContour::isUneven) have a detail of at least 0.8, but where
  /// one of their own was given.
  bool smoothRagged = true;
  bool operator==(const ConstructParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const ConstructParams&);

}  // namespace batten
