// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/pieces.h"

namespace batten {

/// Expert constants of the true and fair fit; lengths in px of the scan. Defaults as tuned on rendered scans.
struct FairFitOptions {
  double knotSpacingPx = 16.0;         ///< [px] > 0. Of the knots of the dense curve, or more where points are sparse.
  double blockPx = 8.0;                ///< [px] > 0. Length over which points are averaged: their noise is correlated.
  double effectiveDofWeight = 3.0;     ///< gamma in RSS/sigma^2 + gamma tr.
  double noiseDensityFloor = 0.0006;   ///< [px^2 px] what pixel models leave on perfect pages: .006 px over 16 px
  int emRounds = 5;                    ///< Of the local prior, by expectation and maximisation.
  double emWidthPx = 40.0;             ///< [px] > 0. Standard deviation of its averages along the piece.
  double extremumSignificance = 20.0;  ///< T: an extremum whose removal costs less is dropped (see costAsked).
  double knotRemovalTolerance =
      0.25;  ///< Of the noise of an edge point: how far fewer control points may move the curve.
  double gateOutlinePx = 1.5, gateStrokePx = 2.5;  ///< [px] Farther from its neighbours' medians a point is an outlier.
};

/// [chi2] What the removal of an extremum of this line must cost for it to be kept: T, and 2 ln (length / 2000 px) more
/// on longer lines. Noise that looks like a bump of three freedoms costs more than 20 at one place of 40 px in 6000,
/// and a long line has many places; so the chance of a false bump is about the same for all of them (less for shorter
/// lines).
double costAsked(const ConstructContour& px, const FairFitOptions&);

/// Fits the edge points of all pieces of a contour: quintic B-splines that lie on the line and have no curvature
/// extremum that was not drawn (pilot, in-frame fit with local penalty, structure test, monotone quadratic program).
/// The noise is pooled over the pieces. @param contour in px (pixel_frame.h), as what is returned.
Result<std::vector<ConstructedPiece>> fairFit(const ConstructContour& contour, const FairFitOptions&,
                                              const RunContext&);

}  // namespace batten
