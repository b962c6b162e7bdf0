// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/run_context.h"
#include "core/construct/light/light_reference.h"
#include "core/construct/light/light_shape.h"

namespace batten {

/// What is held at an end of an open curve beside its position.
enum class LightHold { Position, Tangent, Curvature };

/// Curvatures that an end may have.
struct CurvatureRange {
  double low = 0.0, high = 0.0;  ///< [1/unit of the curve]

  /// By how much a curvature lies above the range, or below it (negative).
  double beyond(double kappa) const { return kappa > high ? kappa - high : kappa < low ? kappa - low : 0.0; }
};

/// Sign of the curvature or of its slope.
enum class LightSign : signed char { Negative = -1, Positive = 1 };

/// What one fit is asked for.
struct LightAsk {
  double tolerance = 0.0;  ///< > 0, unit of the reference.
  /// Whether the curvature first rises or falls; it turns `changes` times. Absent: it may do as it likes.
  std::optional<LightSign> firstSlope = {};
  int changes = 0;
  /// What the curvature first is; it changes its sign `inflections` times at the most. Absent: as it likes.
  std::optional<LightSign> firstKappa = {};
  int inflections = 0;
  LightHold start = LightHold::Position, end = LightHold::Position;
  std::optional<CurvatureRange> startRange = {},
                                endRange = {};  ///< Absent: any curvature. Ends without a held one only.
  /// The first phase, without walls and signs, comes first: needed by most, worse for some single spans.
  bool firstPhase = true;
  double reach = 1.0;         ///< Part of the tolerance to be reached at the places of the fit.
  double signs = 1.0;         ///< Weight of the signs to begin with.
  double signMargin = 0.002;  ///< By which signs are to be right; of tolerances, see LightSystem.
  /// Given up as soon as this many steps of the second phase have been taken.
  int mostSteps = 30;
};

struct LightFit {
  LightShape shape;
  bool reached = false;  ///< Tolerance, signs and ends, at the samples of the fit.
  double worst = 0.0;    ///< Largest |offset| at the samples.
  int iterations = 0;
};

/// Least squares of the normal distance from the reference, with feet renewed in every evaluation, so that the places
/// may slide along it; the tolerance is a soft wall, and the slope of the curvature keeps the signs that cost least
/// (SwitchPlaces). Levenberg-Marquardt over control points and span lengths, analytic derivatives.
LightFit fitLight(const LightReference&, LightShape start, const LightAsk&, const RunContext&);

}  // namespace batten
