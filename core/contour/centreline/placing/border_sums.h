// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/subpixel/response_row.h"

namespace batten {

/// Pixels across a stroke, in fours; those that only make the last four full have weight 0.
struct StrokePixels {
  const double* distance = nullptr;  ///< [px] along the normal.
  const double* weight = nullptr;    ///< [-] >= 0
  const double* grey = nullptr;      ///< [grey]
  int count = 0;                     ///< A multiple of four.
};

/// A stroke of even darkness on even paper, between two borders.
struct StrokeBorders {
  ResponseRow response = {};
  double paper = 255.0, slope = 0.0, contrast = 0.0;  ///< [grey, grey/px, grey]
  double low = 0.0, high = 0.0;                       ///< [px] the borders.
};

/// What the model leaves of each pixel, and its derivatives by the two borders; room for count numbers each.
struct BorderResiduals {
  double* left = nullptr;    ///< [grey] Measured less modelled.
  double* byLow = nullptr;   ///< [grey/px]
  double* byHigh = nullptr;  ///< [grey/px]
};

/// Sums over the pixels for a step of both borders.
struct BorderSums {
  double ll = 0.0, lh = 0.0, hh = 0.0, l = 0.0, h = 0.0;  ///< By weight: normal equations, right side.
  double det() const { return ll * hh - lh * lh; }
};

/// Further sums, of which the uncertainty is told.
struct SquareSums {
  double ll = 0.0, lh = 0.0, hh = 0.0;  ///< By weight squared.
  double squares = 0.0, weights = 0.0;  ///< Of the residuals [grey^2], by weight; of the weights.
};

/// All versions give the same bits: sums are made in the order of the pixels, multiplied and added apart.
struct BorderKernels {
  BorderSums (*sums)(const StrokePixels&, const StrokeBorders&, const BorderResiduals&);
  SquareSums (*squares)(const StrokePixels&, const BorderResiduals&);
};

/// For any processor.
const BorderKernels& plainBorderKernels();
/// The fastest that this processor has.
const BorderKernels& borderKernels();

}  // namespace batten
