// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/cancel_check.h"
#include "core/construct/fair/fair_piece.h"

namespace batten {

/// [px] Median of the standard deviations that the points of a contour came with; absent: they came with none.
std::optional<double> ordinarySigma(const ConstructContour&);

/// Points cleaned and gated; pilot, first frame and the table of cut-offs. @param piece in px.
FairPiece prepareFairPiece(const ConstructPiece& piece, bool isStroke, std::optional<double> ordinarySigmaPx,
                           const FairFitOptions&, CancelCheck);

/// [-] What merged strokes leave open about the line that was meant: a noise density of this part of the cube of half
/// their half-width (a hand wanders over a length proportional to its excursion), …
inline constexpr double kWanderShare = 0.02;
/// … at any one place this part of half their breadth.
inline constexpr double kMeanShare = 0.07;

/// Adapts the weights to the noise along the piece, and to what is left of it above the floor: a weight of 1 is a noise
/// density of max(measured, floor).
/// @param grain noise density of the stroke's grain (stroke_grain.h): the noise is nowhere less.
void weighByNoise(FairData&, const LocalNoise&, double measured, double floor, double grain);

/// [px] By which the curve of a piece too short for the fair fit may miss its points: of a stroke that is seen against
/// its width.
double missAllowedPx(const ConstructPiece&);

/// [px] Median distance of neighbours; 1 for a single point.
double medianSpacing(const FairData&);

/// Marks points as not to be used that lie far from where their neighbours on both sides are (medians, so that outliers
/// cannot vote).
void rejectOutliers(FairData&, double gatePx, double spacing);

}  // namespace batten
