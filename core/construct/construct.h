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

/// How the quintic NURBS uses the gradients (003 section 3).
enum class GradientUse {
  All,          ///< Points and all gradients (000).
  Four,         ///< All points, gradients at the first two and the last two.
  NaturalEnds,  ///< Points only, R'' = R'''' = 0 at the ends.
};

/// One flat set for all methods; each method reads its own fields.
struct ConstructParams {
  ConstructMethod method = ConstructMethod::Fair;
  double derivativeMagnitude = 1.0;  ///< [-] 0.1..3. Factor on the arc-corrected length of the first derivative.
  bool magnitudeAsInPaper = false;   ///< 1/3 of the mean distance of adjacent points instead (000; wrong by 3).
  GradientUse gradients = GradientUse::All;
  int degree = 3;                 ///< 2..5. Control polygon only.
  double keepExtremaCost = 20.0;  ///< [chi2] 1..1000. Fair fit: a curvature extremum cheaper than this is dropped.
  bool operator==(const ConstructParams&) const = default;
};
std::optional<Error> validate(const ConstructParams&);

/// One piece as the constructions take it. Model frame, mm.
struct ConstructPiece {
  std::vector<Vec2>
      points;  ///< Ordered edge points; the first and last are exactly the corners where there are corners.
  std::vector<Station> stations;  ///< Regression segments, model frame.
  bool closed = false;            ///< Smooth closed: the curve is periodic.
  bool startIsCorner = false;
  bool endIsCorner = false;
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
  double removalCost = 0.0;  ///< [chi2] rise of the misfit when it is removed; large = certain.
};

struct ConstructReport {
  Termination why = Termination::NotRun;
  std::string note;                   ///< One line for the user when a fallback was used; else empty.
  std::vector<ExtremumNote> extrema;  ///< Fair fit only.
  std::vector<double> bandS;          ///< [mm] arc lengths at which the band is given (fair fit only).
  std::vector<double> bandSigma;      ///< [1/mm] standard deviation of the curvature there.
  double noisePx = 0.0;               ///< [px] standard deviation of an edge point (fair fit only; 0 = not measured).
  bool isCircle = false;              ///< Recognised as an exact circle.
  bool isLine = false;                ///< Recognised as an exact line.
};
struct ConstructedPiece {
  NurbsCurve curve;  ///< Degree 5 (control polygon: its own degree), clamped, model frame, domain in mm of chord or arc
                     ///< length.
  ConstructReport report;
};

/// Constructs all pieces of a contour, in order. Where a corner bounds a piece the curve ends exactly there. A closed
/// smooth piece gives a curve whose ends meet with all derivatives (Fair, Nurbs, ControlPolygon), with two (Bezier), or with
/// place, direction and curvature (Typical).
/// @return Numerical, with what to do, if a piece holds too little to construct anything.
Result<std::vector<ConstructedPiece>> construct(const ConstructContour&, const ConstructParams&, const RunContext&);

}  // namespace batten
