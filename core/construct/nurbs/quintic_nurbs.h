// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/construct_params.h"
#include "core/construct/pieces.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Derivative magnitudes |R'| for uniform knots of spacing 1 at m stations: mean of the neighbours' arc-corrected
/// chords a_i = c_i (alpha_i / 2) / sin(alpha_i / 2), one-sided at open ends; times `factor`. As in the paper: 1/3 of
/// the mean chord.
std::vector<double> derivativeMagnitudes(std::span<const Station> stations, bool closed, double factor, bool asInPaper);

struct QuinticSystemResult {
  std::vector<Vec2> controlPoints;  ///< m + 4 (open) or m (closed).
  Termination why = Termination::Exact;
  double residualRmsPosition = 0.0;    ///< [unit of the points]
  double residualRmsDerivative = 0.0;  ///< [the same per knot spacing]
};
/// Uniform quintic B-spline (knot spacing 1) from m points and derivative vectors (000 Eq 10, 11; 003 section 3).
/// m = 4 exact, m > 4 least squares by QR with unit weights, m < 4 smallest integral of |R'''|^2 subject to the
/// equations. Closed: m control points, periodic. @pre sizes equal, m >= 2 (closed: m >= 6).
Result<QuinticSystemResult> solveQuintic(std::span<const Vec2> points, std::span<const Vec2> derivatives, bool closed,
                                         GradientUse use);

/// The construction of 000 for one piece: stations to a clamped quintic in the model frame, ends exactly at the
/// stations' end points. Uneven stations get knots at their arc distances, so that equal speed stays right. Where the
/// curve would leave the line by more than params.maxDeviationPx, stations are set closer; not where the paper's own
/// rules are asked for (its magnitude, or even knots with loose lengths).
Result<ConstructedPiece> constructQuinticNurbs(const ConstructPiece&, const ConstructParams&, const RunContext&);

}  // namespace batten
