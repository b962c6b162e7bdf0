// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/base/termination.h"
#include "core/contour/regression_segments.h"
#include "core/curve/nurbs_curve.h"

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
  int degree = 3;                         ///< 2..5. Control polygon only, as the next four.
  SharpKnots knots = SharpKnots::Degree;  ///< Degree or Order.
  PointRemoval removal = PointRemoval::Step;
  double removalStepPx = 8.0;       ///< [px] 0..200. Distance of the points that are kept; 0 keeps all.
  double removalTolerancePx = 1.0;  ///< [px] 0..50. Farthest that a removed point lies from the polygon.
  double lowPass =
      1.0;  ///< [stations] 0..8. Bezier path: standard deviation of the low pass of its curvature; 0 = none.
  /// [px] 0..50. Nurbs, Bezier: where the curve leaves the line by more (and by more than its noise), stations are set
  /// closer, and the report says where that was of no avail; 0 = never (papers).
  double closenessPx = 2.0;
  TypicalMode typical = TypicalMode::Chain;
  double growingStopDeg = 2.0;    ///< [degrees] 0.2..20. Growing: the normals of curve and points may differ by this.
  bool growingAsInPaper = false;  ///< Growing: keeps each fit whole (002; unstable) instead of its first half.
  /// [chi2] 1..1000. Fair fit: a curvature extremum cheaper than this is dropped, on lines of 2000 px and shorter; a
  /// little more is asked on longer ones (ExtremumNote::askedCost).
  double keepExtremaCost = 20.0;
  /// [-] 0..1. Fair fit: part of the noise of an edge point by which the curve may move to need fewer control points;
  /// 0 keeps them all.
  double reduceShare = 0.25;
  bool operator==(const ConstructParams&) const = default;
};
std::optional<Error> validate(const ConstructParams&);

/// What the user wants of the curvature extremum nearest to a place (fair fit only).
struct ExtremumWish {
  Vec2 point = Vec2::Zero();  ///< [mm] model frame, on or near the line.
  bool keep = true;           ///< False: to be removed.
  int id = 0;                 ///< The caller's name for it; comes back in the report.
};

/// One piece as the constructions take it. Model frame, mm.
struct ConstructPiece {
  std::vector<Vec2>
      points;  ///< Ordered edge points; the first and last are exactly the corners where there are corners.
  std::vector<Station> stations;  ///< Regression segments, model frame.
  bool closed = false;            ///< Smooth closed: the curve is periodic.
  std::vector<int> drawn;         ///< Pen strokes: indices of the points that were drawn; empty = all are measured.
  std::vector<std::uint8_t> refined = {};  ///< Per point: 0 = known to the pixel only; empty = all are better known.
  std::vector<float> sigmaPx = {};         ///< [px] per point: standard deviation across the line; empty = all alike.
  /// [px] per point: half the breadth of the strokes that were merged there; empty = none were. The line that was meant
  /// may lie anywhere between them.
  std::vector<float> spreadPx = {};
  bool startIsCorner = false;
  bool endIsCorner = false;
  std::vector<Vec2> divisions;  ///< Places along the line where the user wants typical curves to meet.
  std::vector<ExtremumWish> wishes = {};
};
/// All pieces of one contour: methods may pool what they have in common (noise).
struct ConstructContour {
  std::vector<ConstructPiece> pieces;
  bool isStroke = false;  ///< Centre line of a stroke (else an outline).
  double pixelMm = 1.0;   ///< [mm] size of a scan pixel: the scale of noise.
};

/// A curvature extremum that a construction considered.
struct ExtremumNote {
  double s = 0.0;      ///< [mm] arc length in the piece.
  double kappa = 0.0;  ///< [1/mm]
  bool maximum = true;
  bool kept = true;
  double removalCost = 0.0;      ///< [chi2] rise of the misfit when it is removed; large = certain.
  double askedCost = 0.0;        ///< [chi2] what it had to be at least to be kept.
  Vec2 point = Vec2::Zero();     ///< [mm] where it is on the curve (a dropped one: where it was seen).
  std::optional<int> wish = {};  ///< Id of the wish that was attached to it.
};

/// One segment of a typical chain.
struct SegmentNote {
  bool typical = true;          ///< Else a quintic between two, at an inflection or a straight part.
  Vec2 startMm = Vec2::Zero();  ///< Where it starts.
  double lengthMm = 0.0;
  double ratio = 1.0;                       ///< h
  double turnRad = 0.0;                     ///< Change of direction, 2 phi.
  double startKappa = 0.0, endKappa = 0.0;  ///< [1/mm]
  bool monotone = false;                    ///< h <= cos(phi) or h >= 1 / cos(phi); typical segments only.
};

struct ConstructReport {
  Termination why = Termination::NotRun;
  std::string note;                   ///< One line for the user when a fallback was used; else empty.
  std::vector<ExtremumNote> extrema;  ///< Fair fit only.
  int extremaInTurns = 0;         ///< Fair fit: in turns too sharp for it, so that nothing is known of their certainty.
  std::vector<int> unmetWishes;   ///< Ids of wishes that found no extremum, or one that cannot go.
  std::vector<double> bandS;      ///< [mm] arc lengths at which the band is given (fair fit only).
  std::vector<double> bandSigma;  ///< [1/mm] standard deviation of the curvature there.
  std::vector<SegmentNote> segments;  ///< Typical curves only.
  double noisePx = 0.0;               ///< [px] standard deviation of an edge point (fair fit only; 0 = not measured).
  int stationsAdded = 0;              ///< Nurbs, Bezier: set where the line turns too quickly for those given.
  int pointsBefore = 0;               ///< Control polygon: points of the line (0 = not a control polygon) …
  int pointsAfter = 0;                ///< … that are left after point removal …
  int pointsAdded = 0;                ///< … and control points added between close corners.
  int fullControlPoints = 0;          ///< Of the fair fit before control points were spared (0 = not done).
  double reducedMovedPx = 0.0;        ///< [px] farthest that sparing them moved the curve.
  bool isCircle = false;              ///< Recognised as an exact circle.
  bool isLine = false;                ///< Recognised as an exact line.
};
struct ConstructedPiece {
  NurbsCurve curve;  ///< Degree 5 (control polygon: its own degree), clamped, model frame, domain in mm of chord or arc
                     ///< length.
  ConstructReport report;
};

/// Constructs all pieces of a contour, in order. Where a corner bounds a piece the curve ends exactly there (but for
/// SharpKnots::Order, which breaks it). A closed
/// smooth piece gives a curve whose ends meet with all derivatives (Fair, Nurbs, ControlPolygon), with two (Bezier), or
/// with place, direction and curvature (Typical).
/// @return Numerical, with what to do, if a piece holds too little to construct anything.
Result<std::vector<ConstructedPiece>> construct(const ConstructContour&, const ConstructParams&, const RunContext&);

}  // namespace batten
