// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/fair/fair_noise.h"
#include "core/construct/fair/fair_posterior.h"
#include "core/construct/fair/fair_simple.h"
#include "core/construct/pieces.h"

namespace batten {

/// One piece of a contour between the steps of the fair fit.
struct FairPiece {
  FairData data;                   ///< px, relative to `origin`.
  Vec2 origin = Vec2::Zero();      ///< px.
  FairPins pins;                   ///< As data.
  std::optional<FairFrame> frame;  ///< About the pilot; absent: too short for the fair fit.
  CutoffTable table;
  Eigen::VectorXd rough;  ///< Offsets from the pilot by the cut-off of the piece.
  double squares = 0.0;   ///< Of the residuals of single points about the result.
  int pointCount = 0;
  std::optional<Result<ConstructedPiece>> result;
};

/// [px] Median of the standard deviations that the points of a contour came with; 0: they came with none.
double ordinarySigma(const ConstructContour&);

/// Points in px, cleaned and gated; pilot, first frame and the table of cut-offs.
FairPiece prepareFairPiece(const ConstructPiece&, bool isStroke, double pixelMm, double ordinarySigmaPx,
                           const FairFitOptions&);

/// [-] What merged strokes leave open about the line that was meant: a noise density of this part of the cube of half
/// their breadth (hands stray over a way that goes with how far they stray), …
inline constexpr double kWanderShare = 0.02;
/// … at any one place this part of half their breadth.
inline constexpr double kMeanShare = 0.07;

/// Adapts the weights to the noise along the piece, and to what is left of it above the floor: a weight of 1 is a noise
/// density of max(measured, floor).
void weighByNoise(FairData&, const LocalNoise&, double measured, double floor);

/// The rest, once noise and cut-off are known and `rough` is set: sets `result`, `squares` and `pointCount`. Leaves
/// `result` absent when cancelled. `willBeCut`: a piece whose smoothing already leaves its points will be cut there and
/// fitted again, and gets no more than that smoothing.
void finishFairPiece(FairPiece&, const ConstructPiece&, double pixelMm, double s0, double cutoffPx, bool willBeCut,
                     const FairFitOptions&, const RunContext&);

/// Median distance of neighbours; 1 for a single point.
double medianSpacing(const std::vector<Vec2>& points);
/// Marks points as not to be used that lie far from where their neighbours on both sides are (medians, so that strays
/// cannot vote).
void gateStrays(FairData&, double gatePx, double spacing);

}  // namespace batten
