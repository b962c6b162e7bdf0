// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/centreline/centreline.h"
#include "core/contour/edge_params.h"
#include "core/image/bits/bit_image.h"
#include "core/image/bits/run_pieces.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// What a pencil drew of a page.
struct PencilInk {
  BitImage ink;           ///< As it was thresholded.
  BitImage body;          ///< All of it but its shapes, with the grain closed.
  double widthPx = 1.0;   ///< [px] Of its strokes, or of the pens beside them if those are wider.
  double pencilPx = 1.0;  ///< [px] Of its strokes alone.
};

/// The ink of a page by trace mode. Both pictures have the size of the ink and share no pixel.
struct InkSplit {
  BitImage strokes;                        ///< Along their middle.
  BitImage shapes;                         ///< Along their border.
  std::optional<BitImage> swellings = {};  ///< InkLabels::swellings.
  std::optional<PencilInk> pencil = {};    ///< Absent: nothing was drawn with a pencil.
  std::optional<BitImage> painted = {};    ///< Ink whose kind the user has painted; absent: he painted nothing.
  RunPieces regions;  ///< What the user changes the kind of with one click: connected parts of one kind, before the
                      ///< choices. What was painted is apart from what was not.
  std::unique_ptr<StrokesOfInk> known;  ///< What was found on the way; absent where nothing was.
  std::optional<BitImage> clear = {};   ///< Paper that lettering of a pencil had closed; absent: none was found.
  std::optional<double> penPx = {};     ///< [px] width of the strokes; absent: none was looked for, or there are none.
};

/// Splits the ink into strokes and shapes, region by region (label/ink_labels.h), unless the page is followed in one
/// way (EdgeParams::mode); ink that the user painted is what he painted it as, and regions that he chose for follow his
/// choice. Ink drawn with a pencil is split piece by piece (splitStrokes), but what many even lines are part of goes to
/// the strokes, and of its tones only solids far wider than its strokes are shapes.
/// @param page what an enlarged ink and grey were made of (fine_page.h), else absent.
/// @param paper of the grey, by which paper that the strokes of a pen have closed is found (narrow_paper.h), in letters
/// down to half a stroke's width; absent: none is looked for.
Result<InkSplit> splitInk(const BitImage& ink, const GreyImage& grey, const EdgeParams&, const RunContext&,
                          const GreyImage* page = nullptr, const PaperBackground* paper = nullptr);

}  // namespace batten
