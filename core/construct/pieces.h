// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/termination.h"
#include "core/base/vec2.h"
#include "core/contour/corner/piece_line.h"
#include "core/contour/segment/regression_segments.h"
#include "core/curve/nurbs_curve.h"

/// What goes into the constructions and what comes out of them: in mm, as stated here, outside of construct(); in px of
/// the scan, the unit in which noise has its size, inside of it (pixel_frame.h).
namespace batten {

/// What the user wants of the curvature extremum nearest to a place (fair fit only).
struct ExtremumConstraint {
  Vec2 point = Vec2::Zero();  ///< [mm] model frame, on or near the line.
  bool keep = true;           ///< False: to be removed.
  int id = 0;                 ///< The caller's name for it; comes back in the report.
};

/// What grain does to the line of a stroke or of a filled shape (stroke_grain.h); 0: nothing that its points do not
/// show.
struct StrokeGrain {
  double density = 0.0;  ///< [px^2 px] Noise density at wavelengths of several widths.
  double sigmaPx = 0.0;  ///< [px] Standard deviation of the line, in the mean over one stroke width or 8 px.
};

/// One piece as the constructions take it. Model frame, mm.
struct ConstructPiece : PieceLine {
  std::vector<Station> stations = {};  ///< Regression segments, model frame.
  bool isDrawn = false;  ///< Of a pen stroke or an imported line: `refined` tells the points that were given.
  std::vector<Vec2> breakpoints = {};  ///< Places along the line where the user wants typical curves to meet.
  std::vector<ExtremumConstraint> constraints = {};
  std::optional<double> detail = {};  ///< 0..1. Its own, instead of ConstructParams::detail.
  StrokeGrain grain = {};             ///< Of its contour; the fair fit measures it.
};

/// All pieces of one contour: methods may pool what they have in common (noise).
struct ConstructContour {
  std::vector<ConstructPiece> pieces;
  bool isStroke = false;                  ///< Centre line of a stroke (else an outline).
  std::optional<double> pencilPx = {};    ///< [px] width of the pencil that filled an outline; absent: no grain.
  bool isUneven = false;                  ///< The outline of uneven ink, whose border the tool may have frayed.
  double pixelMm = 1.0;                   ///< [mm] size of a scan pixel; 1 of a contour in px.
  std::optional<double> inkWidthPx = {};  ///< [px] width of the page's strokes and shapes; absent: not known.
};

/// A curvature extremum that a construction considered.
struct ExtremumNote {
  double s = 0.0;      ///< [mm] arc length in the piece.
  double kappa = 0.0;  ///< [1/mm]
  bool maximum = true;
  bool kept = true;
  double removalCost = 0.0;            ///< [chi2] rise of the misfit when it is removed; large = certain.
  double askedCost = 0.0;              ///< [chi2] what it had to be at least to be kept.
  Vec2 point = Vec2::Zero();           ///< [mm] where it is on the curve (a dropped one: where it was seen).
  std::optional<int> constraint = {};  ///< Id of the constraint that was attached to it.
};

/// Noise of a fit at one place.
struct NoiseNote {
  double s = 0.0;      ///< [mm] arc length in the piece.
  double sigma = 0.0;  ///< [1/mm] standard deviation of the curvature there.
};

/// Why a segment of a chain is no typical curve.
enum class SegmentCause {
  None,        ///< It is one.
  Straight,    ///< It turns by less than 3 degrees.
  Inflection,  ///< The curvature changes its sign, or has none at an end.
  Even,        ///< The curvature hardly changes: a typical curve would rise and fall there (002: monotone only for h <=
               ///< cos phi or h >= 1 / cos phi); or none lies near enough.
};

/// One segment of a typical chain.
struct SegmentNote {
  bool typical = true;  ///< Else a quintic between two, for the reason below.
  SegmentCause cause = SegmentCause::None;
  Vec2 start = Vec2::Zero();                ///< [mm] Where it starts.
  double length = 0.0;                      ///< [mm]
  double ratio = 1.0;                       ///< h
  double turnRad = 0.0;                     ///< Change of direction, 2 phi.
  double startKappa = 0.0, endKappa = 0.0;  ///< [1/mm]
  bool monotone = false;                    ///< h <= cos(phi) or h >= 1 / cos(phi); typical segments only.
};

/// Part of the length of a chain that its segments of one kind make, 0..1.
inline double shareOf(SegmentCause cause, std::span<const SegmentNote> segments) {
  double part = 0.0, all = 0.0;
  for (const SegmentNote& one : segments) {
    all += one.length;
    if (one.cause == cause) part += one.length;
  }
  return all > 0.0 ? part / all : 0.0;
}
/// The part that typical curves make.
inline double typicalShare(std::span<const SegmentNote> segments) { return shareOf(SegmentCause::None, segments); }

/// Result of making a curve light (construct.light).
struct LightNote {
  bool found = false;     ///< False: nothing lighter holds the tolerance and the extrema; the curve is the dense one.
  bool exact = false;     ///< An exact line, arc or circle.
  int points = 0;         ///< Control points of the curve, as the list of curves and the files count them.
  int pointsBefore = 0;   ///< The same of the dense curve.
  double movedPx = 0.0;   ///< [px] largest distance of the two.
  int sections = 1;       ///< More than 1: it was cut into sections that meet with one curvature …
  int sectionsDense = 0;  ///< … of which these are as dense as they were.
  double tolerancePx = 0.0;  ///< [px] that it was made with.
  int corners = 0;  ///< Sharp corners inside, which were found at the scale of the tolerance (construct.detail).
  bool isSimplified = false;  ///< Made with construct.detail above 0: what was meant, which fairing starts from.
  std::string why;            ///< Why the curve, or a section of it, stayed dense; else empty.
};

/// Points of a control polygon.
struct PolygonNote {
  int before = 0;  ///< Points of the line …
  int after = 0;   ///< … that are left after point removal …
  int added = 0;   ///< … and control points added between close corners.
};

struct ConstructReport {
  Termination why = Termination::NotRun;
  std::string note;                    ///< One line for the user when a fallback was used; else empty.
  std::vector<ExtremumNote> extrema;   ///< Fair fit only.
  int extremaInSharpFeatures = 0;      ///< Fair fit: at sharp features, where significance is not tested.
  std::vector<int> unmetConstraints;   ///< Ids of constraints that found no extremum, or one that cannot go.
  std::vector<NoiseNote> noise;        ///< Ascending in s (fair fit only).
  std::vector<SegmentNote> segments;   ///< Typical curves only.
  std::optional<double> noisePx = {};  ///< [px] standard deviation of an edge point; fair fit, where it was measured.
  int stationsAdded = 0;               ///< Nurbs, Bezier: set where the line turns too quickly for those given.
  std::optional<PolygonNote> polygon = {};    ///< Control polygons.
  std::optional<int> fullControlPoints = {};  ///< Of the fair fit before knot removal; absent: it was not fitted.
  double knotRemovalMovedPx = 0.0;            ///< [px] largest move of the curve by knot removal.
  std::optional<LightNote> light = {};        ///< Fair fit, where light curves were asked for.
  bool isCircle = false;                      ///< Recognised as an exact circle.
  bool isLine = false;                        ///< Recognised as an exact line.
};
struct ConstructedPiece {
  /// Clamped, model frame, domain in mm of chord or arc length. Degree 5, but for light curves (1 to 7; arcs are
  /// rational quadratics) and control polygons (their own degree).
  NurbsCurve curve;
  ConstructReport report;
  /// What fairing starts from; absent: `curve` itself. Of a light curve the one that it was made of, degree 5; of one
  /// that was simplified (LightNote::isSimplified) the same curve with more knots.
  std::optional<NurbsCurve> dense = {};
};

}  // namespace batten
