// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/construct/pieces.h"

/// Constructions work in px of the scan, the unit in which noise has its size. What they are given and what they make
/// is in mm: construct() converts once at its beginning and once at its end, by these two; growingSteps() alike.
namespace batten {

/// The contour with lengths in px, axes as they are; its pixelMm is 1. @pre pixelMm > 0.
ConstructContour inPixels(const ConstructContour& mm);

/// A curve and its report in mm. An end that is a point or a station of the piece is that place to the last digit, so
/// that pieces meet.
/// @param made in px, not rational. @param px, mm its piece in both units. @param pixelMm [mm] size of a pixel.
Result<ConstructedPiece> inMillimetres(ConstructedPiece made, const ConstructPiece& px, const ConstructPiece& mm,
                                       double pixelMm);

}  // namespace batten
