// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/paper_background.h"

namespace batten {

/// What addEvenStrokes looks at; all of one size.
struct EvenStrokeSources {
  const GreyImage& image;
  const PaperBackground& paper;  ///< Of the image, with the folds that are in both.
  const BitImage& faint;         ///< Everything that stands out of the paper.
  double inkDepth;               ///< [grey] Of the ink of the page, below the paper.
};

/// Adds to the ink what a pale marker drew beside dark lines: places that stand out of the paper, are long for their
/// width, no wider than a pen, of one grey inside, and a quarter as dark as ink or more. Shading, shadows and the
/// strokes of a pencil are of many greys, fainter hatching is a tone, and so is an area that lines bound; what runs out
/// of the picture is no stroke.
/// @param pixelsPerPx of the image, along a pixel of the page (fine_page.h).
BitImage addEvenStrokes(BitImage ink, const EvenStrokeSources& sources, const RunContext& context, int pixelsPerPx = 1);

}  // namespace batten
