// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/vec2.h"
#include "core/construct/fair/fair_fit.h"
#include "core/curve/uniform_quintic.h"
#include "core/solve/banded_matrix.h"

namespace batten {

/// One point on its way through the fair fit.
struct FairPoint {
  Vec2 at = Vec2::Zero();  ///< [px]
  bool use = true;         ///< False: gated out or too near a corner.
  double weight = 1.0;     ///< 1 / variance, 1 being that of an ordinary point of the contour.
  double spread = 0.0;     ///< [px] half-width of the bundle of merged strokes; 0: single stroke.
  double t = 0.0;          ///< Parameter of the foot point on the current curve.
};

/// The points of one piece; px, relative to their centroid.
struct FairData {
  std::vector<FairPoint> points;
  bool closed = false;
  double density = 1.0;  ///< [1/px] points per length, at most 1.
};

/// Curvature of the frame curve and how an offset d along its left normal changes it, to first order:
/// kappa(d) = kp + d'' + kp^2 d and its two derivatives with respect to arc length.
struct FrameStation {
  double u = 0.0;                               ///< [px] Parameter of the frame curve.
  double kappa = 0.0, slope = 0.0, bend = 0.0;  ///< [1/px, 1/px^2, 1/px^3] kp, kp', kp''.
  BandRow kappaRow, slopeRow, bendRow;          ///< Their change by the coefficients of d.
};

/// The same from derivatives 0..4 of the curve, which runs at about unit speed, and the basis rows of these orders.
FrameStation frameStation(const PlaneDerivatives&, const std::array<BandRow, 5>& rows);
/// Its curvature alone, from derivatives 1 and 2.
double frameCurvature(const PlaneDerivatives&);

/// The mean of the points over some px of the line.
struct FairBlock {
  double u = 0.0, offset = 0.0;  ///< [px] Parameter of the frame curve, distance to its left.
  double weight = 0.0;           ///< Of the mean: 1 for a block full of ordinary points.
  BandRow row;                   ///< The basis functions at `u`.
};

/// The linear problem for offsets from a curve.
struct FairFrame {
  UniformQuintic base;
  double blockLength = 8.0, cell = 0.0;  ///< [px] length per block, per station of the penalty.
  std::vector<FairBlock> blocks;
  std::vector<FrameStation> penalty;  ///< Midpoints of thirds of spans.
  std::vector<FrameStation> checks;   ///< Where signs are asked for; see checkStations.
  BandedMatrix h;                     ///< Data term.
  Eigen::VectorXd g;
  double squares = 0.0;                         ///< Sum of squared residuals of the single points about the base curve.
  int pointCount = 0;                           ///< Single points in `squares`.
  double weightedSquares = 0.0, weights = 0.0;  ///< The same by weight; sum of the weights.
};

/// Uniform knots for a length: spacing as near to `spacingPx` as whole spans allow.
UniformKnots fairKnots(double length, double spacingPx, bool closed);

/// Rough curve through the points by their own order: penalised least squares with Tukey weights, four passes. Sets
/// the feet of the points.
std::optional<UniformQuintic> fitPilot(FairData& data, const FairFitOptions&, CancelCheck);

/// Projects the points on the curve (updates their feet), averages them by their weights over blocks and sets up the
/// rows.
/// @param checksPerSpan check stations a span; 0 leaves them out.
FairFrame assembleFrame(const UniformQuintic& base, FairData& data, const FairFitOptions&, int checksPerSpan,
                        CancelCheck);

/// Stations at equal steps, `perSpan` a span; open: and the end.
std::vector<FrameStation> checkStations(const UniformQuintic& base, int perSpan, CancelCheck check = {});

/// One place by the parameters of two curves.
struct ParameterPair {
  double before = 0.0, after = 0.0;  ///< [px]
};

/// The curve base + d N from parameter `from` to `to` as a spline of its own arc length, with as many spans.
struct Reframed {
  UniformQuintic curve;
  std::vector<ParameterPair> places;  ///< On the base and on the curve, ascending.
};
/// The parameter on the curve of one on the base; between the places linear, and on beyond their ends.
/// @pre two places at least.
double parameterAfter(const std::vector<ParameterPair>& places, double before);
/// Absent when it has no finite length, and when cancelled.
std::optional<Reframed> reframe(const UniformQuintic& base, const Eigen::VectorXd& d, double from, double to,
                                CancelCheck);
/// base + d N with the same knots and parameter.
std::optional<UniformQuintic> offsetCurve(const UniformQuintic& base, const Eigen::VectorXd& d, CancelCheck);

/// The position base + d N and its first derivative.
struct OffsetPoint {
  Vec2 point, velocity;  ///< [px, px per px of the parameter]
};
OffsetPoint offsetPoint(const UniformQuintic& base, const Eigen::VectorXd& d, double u);

}  // namespace batten
