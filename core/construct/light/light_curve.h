// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/light/light_fit.h"
#include "core/construct/light/removal_deviation.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Lengths in the unit of the curve.
struct LightOptions {
  double tolerance = 0.05;  ///< > 0. Largest distance from the dense curve.
  double step = 0.5;        ///< > 0. Distance of the samples that the dense curve is known by.
  double significance =
      0.1;  ///< >= 0. Extrema whose removal moves the curve by less than this part of the tolerance may go.
  LightHold start = LightHold::Position, end = LightHold::Position;  ///< Open curves.
  /// A curve of more control points is not wanted: the search is given up as soon as there can be no other, with
  /// LightObstacle::Points.
  int mostPoints = std::numeric_limits<int>::max();
};

enum class LightKind {
  Dense,   ///< Nothing lighter was found: the curve as it was, and LightReport::obstacle says why.
  Line,    ///< Exactly straight.
  Arc,     ///< Exactly an arc or a circle (rational).
  Span,    ///< One polynomial span of degree 2..7.
  Spline,  ///< Quintic with simple knots (C4).
  Chain,   ///< Quintic of sections that meet with one curvature (G2), or simplified sections between corners.
};

/// Why a curve, or sections of it, stayed dense.
enum class LightObstacle {
  None,
  NoNormal,   ///< It has no direction somewhere, or a corner inside.
  Structure,  ///< No curve of fewer control points that was tried holds the tolerance and the curvature's extrema.
  Effort,     ///< The search was given up: there are too many extrema.
  Points,     ///< More than LightOptions::mostPoints are needed.
};

struct LightReport {
  LightKind kind = LightKind::Dense;
  int points = 0;        ///< Control points that are free: of a closed curve each once, arc or circle 3.
  int pointsBefore = 0;  ///< Of the dense curve.
  double worst = 0.0;    ///< Largest distance from the dense curve.
  int extrema = 0;       ///< Of the light curve.
  int extremaAsked = 0;  ///< At the most: the significant ones of the dense curve.
  int inflections = 0;   ///< Of the light curve.
  int iterations = 0;    ///< Of Levenberg-Marquardt, failed tries included.
  int tries = 0;
  int sections = 1, sectionsDense = 0;  ///< Of a chain; those that nothing lighter was found for are as they were.
  LightObstacle obstacle = LightObstacle::None;
  int corners = 0;                     ///< Sharp ones that simplifiedCurve set between sections.
  int necks = 0;                       ///< Spikes and inlets that it cut off.
  std::vector<RankedExtremum> ranked;  ///< All extrema of the dense curve with their removal deviations.
};

struct LightCurve {
  NurbsCurve curve;
  LightReport report;
};

/// A curve for which more than LightOptions::mostPoints are needed.
LightCurve tooManyPoints(const NurbsCurve& dense);

/// The curve of fewest control points found that lies within the tolerance of a dense one and has no more curvature
/// extrema and inflections than it (strict check). Closed curves come back clamped, their ends meeting with all
/// derivatives of the spline. Curves of many extrema are cut between them, and at tight turns, and each section is made
/// light for itself with its ends held to the second order; one for which nothing lighter is found stays as it is. A
/// curve with a corner inside, and one that no lighter curve was found for, comes back as it is (LightKind::Dense).
/// @return Cancelled, or BadParameter for a tolerance or step that is not above 0.
Result<LightCurve> makeLight(const NurbsCurve& dense, bool closed, const LightOptions&, const RunContext&);

}  // namespace batten
